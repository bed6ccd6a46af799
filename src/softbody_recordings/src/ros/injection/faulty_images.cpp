#include "ros/injection/faulty_images.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/time/time.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody::injection {
namespace {

namespace encodings = sensor_msgs::image_encodings;

/// A message whose pixels can be changed in place: the original where its pixels are as OpenCV holds them,
/// otherwise a copy with these pixels.
void changeInPlace(const cv::Mat& pixels, const std::string& encoding, sensor_msgs::Image* image) {
  if (pixels.data == image->data.data()) return;
  *image = *cv_bridge::CvImage(image->header, encoding, pixels).toImageMsg();
}

/// The pixels of such a message.
cv::Mat pixelsIn(int type, sensor_msgs::Image* image) {
  return cv::Mat(static_cast<int>(image->height), static_cast<int>(image->width), type, image->data.data(),
                 image->step);
}

}  // namespace

FaultyImages::FaultyImages(std::string topic, bool is_depth, const ImageFaults& faults)
    : topic_(std::move(topic)), is_depth_(is_depth), faults_(faults) {}

sensor_msgs::Image FaultyImages::next(const sensor_msgs::Image& original) try {
  const Nanoseconds stamp = toNanoseconds(original.header.stamp);
  if (count_ == 0) first_ = stamp;
  const bool occluded = occluderPresent(seconds(stamp - first_), faults_);
  sensor_msgs::Image image = original;
  if (!is_depth_ && (occluded || faults_.misplaced_share > 0.0)) changeColor(occluded, &image);
  if (is_depth_ && (occluded || faults_.hole_share > 0.0)) changeDepth(occluded, &image);
  ++count_;
  return image;
} catch (const std::invalid_argument& error) {
  throw std::invalid_argument(fmt::format("{}: image {}: {}; validate_bag says more about the recording",
                                          topic_, count_, error.what()));
}

void FaultyImages::changeColor(bool occluded, sensor_msgs::Image* image) const {
  const cv::Mat3b bgr = colorFromMessage(*image);
  const bool rgb = image->encoding == encodings::RGB8;
  if (!rgb && image->encoding != encodings::BGR8) changeInPlace(bgr, encodings::BGR8, image);
  cv::Mat3b color = pixelsIn(CV_8UC3, image);
  if (faults_.misplaced_share > 0.0) misplaceBlocks(faults_, count_, &color);
  if (occluded) occludeColor(faults_, rgb, &color);
}

void FaultyImages::changeDepth(bool occluded, sensor_msgs::Image* image) const {
  const cv::Mat pixels = depthFromMessage(*image);
  const int type = pixels.type();
  changeInPlace(pixels, type == CV_16UC1 ? encodings::TYPE_16UC1 : encodings::TYPE_32FC1, image);
  cv::Mat depth = pixelsIn(type, image);
  if (occluded) occludeDepth(faults_, &depth);
  punchHoles(faults_, count_, &depth);
}

}  // namespace softbody::injection
