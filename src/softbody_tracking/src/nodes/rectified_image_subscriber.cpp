#include "nodes/rectified_image_subscriber.h"

#include <cv_bridge/cv_bridge.h>
#include <sensor_msgs/image_encodings.h>

#include <utility>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/topics.h"

namespace softbody {
namespace {

// Stamps for which the synchroniser waits at the same time: the three messages of a frame come close
// together.
constexpr int kSynchronizerQueue = 4;

}  // namespace

RgbdFrame frameFromImages(const RectifiedImages& images) {
  const auto color = cv_bridge::toCvShare(images.color, sensor_msgs::image_encodings::BGR8);
  const auto depth = cv_bridge::toCvShare(images.depth, sensor_msgs::image_encodings::TYPE_32FC1);
  return {toNanoseconds(images.color->header.stamp), pinholeFromMessage(*images.info), color->image,
          depth->image};
}

RectifiedImageSubscriber::RectifiedImageSubscriber(ros::NodeHandle handle, Callback callback)
    : callback_(std::move(callback)),
      color_(handle, topics::kRgbRect, 1),
      depth_(handle, topics::kDepthRect, 1),
      info_(handle, topics::kRgbInfo, 1),
      synchronizer_(color_, depth_, info_, kSynchronizerQueue) {
  synchronizer_.registerCallback(&RectifiedImageSubscriber::onImages, this);
}

}  // namespace softbody
