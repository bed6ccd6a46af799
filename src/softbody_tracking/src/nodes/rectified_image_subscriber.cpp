#include "nodes/rectified_image_subscriber.h"

#include <utility>

#include "softbody_common/ros/time.h"
#include "softbody_common/topics.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
RgbdFrame frameFromImages(const RectifiedImages& images) {
  return frameFromRectified(*images.color, *images.depth, *images.info);
}

RectifiedImageSubscriber::RectifiedImageSubscriber(ros::NodeHandle handle, Callback callback)
    : callback_(std::move(callback)) {
  using sensor_msgs::CameraInfo;
  using sensor_msgs::Image;
  const auto stamp = [](const auto& message) { return toNanoseconds(message->header.stamp); };
  color_ = handle.subscribe<Image>(topics::kRgbRect, 1, [this, stamp](const auto& color) {
    pass(assembler_.addColor(stamp(color), color));
  });
  depth_ = handle.subscribe<Image>(topics::kDepthRect, 1, [this, stamp](const auto& depth) {
    pass(assembler_.addDepth(stamp(depth), depth));
  });
  info_ = handle.subscribe<CameraInfo>(
      topics::kRgbInfo, 1, [this, stamp](const auto& info) { pass(assembler_.addInfo(stamp(info), info)); });
}

}  // namespace softbody
