#include "ros/label_reader.h"

#include <cv_bridge/cv_bridge.h>
#include <fmt/format.h>
#include <rosbag/view.h>
#include <sensor_msgs/image_encodings.h>

#include <stdexcept>

#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/recorded_images.h"

namespace softbody::evaluation {
namespace {

/// The label images of a bag in their order, one at a time, because all of them need much memory.
class LabelImages {
 public:
  LabelImages(const std::string& path, const std::string& topic)
      : bag_(openBag(path)), topic_(topic), view_(bag_, rosbag::TopicQuery(topic)), at_(view_.begin()) {}

  /// The next image; null after the last one.
  sensor_msgs::ImageConstPtr next() {
    if (at_ == view_.end()) return nullptr;
    sensor_msgs::ImageConstPtr image = recordedImage(*at_++, bag_);
    if (image->encoding == sensor_msgs::image_encodings::MONO8) return image;
    throw std::invalid_argument(fmt::format("{}: the images on {} are {} instead of mono8",
                                            bag_.getFileName(), topic_, image->encoding));
  }

 private:
  rosbag::Bag bag_;
  std::string topic_;
  rosbag::View view_;
  rosbag::View::iterator at_;
};

}  // namespace

std::optional<LabelReport> compareLabels(const std::string& result, const std::string& result_topic,
                                         const std::string& truth, const std::string& truth_topic) {
  LabelImages found(result, result_topic), expected(truth, truth_topic);
  LabelAgreement agreement;
  sensor_msgs::ImageConstPtr truth_image = expected.next();
  for (auto image = found.next(); image; image = found.next()) {
    while (truth_image && truth_image->header.stamp < image->header.stamp) truth_image = expected.next();
    if (!truth_image) break;
    if (truth_image->header.stamp != image->header.stamp) continue;
    try {
      agreement.add(cv_bridge::toCvShare(truth_image)->image, cv_bridge::toCvShare(image)->image);
    } catch (const std::invalid_argument& fault) {
      throw std::invalid_argument(fmt::format("{}: {}: {}", result, result_topic, fault.what()));
    }
  }
  return agreement.report();
}

}  // namespace softbody::evaluation
