#include "ros/injection/faulty_images.h"

#include <fmt/format.h>
#include <sensor_msgs/image_encodings.h>

#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/time.h"

namespace softbody::injection {
namespace {

namespace encodings = sensor_msgs::image_encodings;

/// The message's pixels without a copy. @throw std::invalid_argument if the number of bytes is wrong.
cv::Mat pixels(const std::string& topic, int type, sensor_msgs::Image* image) {
  const std::size_t row = static_cast<std::size_t>(image->width) * CV_ELEM_SIZE(type);
  if (image->step < row || image->data.size() < static_cast<std::size_t>(image->step) * image->height)
    throw std::invalid_argument(fmt::format(
        "{}: an image has a wrong number of bytes for its size; validate_bag says more about the recording",
        topic));
  return cv::Mat(static_cast<int>(image->height), static_cast<int>(image->width), type, image->data.data(),
                 image->step);
}

[[noreturn]] void refuse(const std::string& topic, const sensor_msgs::Image& image, const char* needed) {
  throw std::invalid_argument(
      fmt::format("{} has encoding {}; {} is needed to change it", topic, image.encoding, needed));
}

}  // namespace

FaultyImages::FaultyImages(std::string topic, bool is_depth, const ImageFaults& faults)
    : topic_(std::move(topic)), is_depth_(is_depth), faults_(faults) {}

sensor_msgs::Image FaultyImages::next(const sensor_msgs::Image& original) {
  const Nanoseconds stamp = toNanoseconds(original.header.stamp);
  if (count_ == 0) first_ = stamp;
  const bool occluded = occluderPresent(seconds(stamp - first_), faults_);
  sensor_msgs::Image image = original;
  if (!is_depth_ && (occluded || faults_.misplaced_share > 0.0)) changeColor(occluded, &image);
  if (is_depth_ && (occluded || faults_.hole_share > 0.0)) changeDepth(occluded, &image);
  ++count_;
  return image;
}

void FaultyImages::changeColor(bool occluded, sensor_msgs::Image* image) const {
  const bool rgb = image->encoding == encodings::RGB8;
  if (!rgb && image->encoding != encodings::BGR8) refuse(topic_, *image, "rgb8 or bgr8");
  cv::Mat3b color = pixels(topic_, CV_8UC3, image);
  if (faults_.misplaced_share > 0.0) misplaceBlocks(faults_, count_, &color);
  if (occluded) occludeColor(faults_, rgb, &color);
}

void FaultyImages::changeDepth(bool occluded, sensor_msgs::Image* image) const {
  const bool millimetres = image->encoding == encodings::TYPE_16UC1 || image->encoding == encodings::MONO16;
  if (!millimetres && image->encoding != encodings::TYPE_32FC1) refuse(topic_, *image, "16UC1 or 32FC1");
  cv::Mat depth = pixels(topic_, millimetres ? CV_16UC1 : CV_32FC1, image);
  if (occluded) occludeDepth(faults_, &depth);
  punchHoles(faults_, count_, &depth);
}

}  // namespace softbody::injection
