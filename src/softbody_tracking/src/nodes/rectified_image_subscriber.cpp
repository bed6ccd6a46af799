#include "nodes/rectified_image_subscriber.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/topics.h"

namespace softbody {
RgbdFrame frameFromImages(const RectifiedImages& images) {
  const auto color = cv_bridge::toCvShare(images.color, sensor_msgs::image_encodings::BGR8);
  const auto depth = cv_bridge::toCvShare(images.depth, sensor_msgs::image_encodings::TYPE_32FC1);
  return {toNanoseconds(images.color->header.stamp), pinholeFromMessage(*images.info), color->image,
          depth->image};
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
