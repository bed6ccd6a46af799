#include "nodes/rectified_image_subscriber.h"

#include <utility>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/time.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
namespace {

constexpr int kQueue = 10;  // messages of each topic, until the assembler takes them

}  // namespace

RgbdFrame frameFromImages(const RectifiedImages& images) {
  return frameFromRectified(*images.color, *images.depth, *images.info);
}

RectifiedImageSubscriber::RectifiedImageSubscriber(ros::NodeHandle handle, Callback callback)
    : frames_(handle.getCallbackQueue(), std::move(callback)) {
  using sensor_msgs::CameraInfo;
  using sensor_msgs::Image;
  const auto stamp = [](const auto& message) { return toNanoseconds(message->header.stamp); };
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  color_ = handle.subscribe<Image>(
      topics::kRgbRect, kQueue,
      [this, stamp](const auto& color) { pass(assembler_.addColor(stamp(color), color)); }, {}, hints);
  depth_ = handle.subscribe<Image>(
      topics::kDepthRect, kQueue,
      [this, stamp](const auto& depth) { pass(assembler_.addDepth(stamp(depth), depth)); }, {}, hints);
  info_ = handle.subscribe<CameraInfo>(
      topics::kRgbInfo, kQueue,
      [this, stamp](const auto& info) { pass(assembler_.addInfo(stamp(info), info)); }, {}, hints);
}

}  // namespace softbody
