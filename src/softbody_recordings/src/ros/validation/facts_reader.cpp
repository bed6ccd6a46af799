#include "softbody_recordings/ros/facts_reader.h"

#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/recorded_images.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody::validation {
namespace {

constexpr std::size_t kDepthSamples = 30, kShiftSamples = 20;
constexpr double kSameTime_s = 0.015;
constexpr std::size_t kPixelStep = 7;  // every 7th pixel is enough for the median

bool isMalformed(const sensor_msgs::Image& image) {
  namespace enc = sensor_msgs::image_encodings;
  std::size_t bytes = 0;
  try {
    bytes = static_cast<std::size_t>(enc::numChannels(image.encoding) * enc::bitDepth(image.encoding) / 8);
  } catch (const std::runtime_error&) {  // another check finds unknown encodings
  }
  return image.width == 0 || image.height == 0 || image.step < image.width * bytes ||
         image.data.size() != static_cast<std::size_t>(image.step) * image.height;
}

void addTimes(const std_msgs::Header& header, const ros::Time& received, StreamFacts* stream) {
  stream->stamps.push_back(toNanoseconds(header.stamp));
  stream->received.push_back(toNanoseconds(received));
  stream->frame_ids.insert(header.frame_id);
}

CameraFacts factsOf(const sensor_msgs::CameraInfo& info) {
  return {static_cast<int>(info.width),
          static_cast<int>(info.height),
          info.K[0],
          info.K[4],
          info.K[2],
          info.K[5],
          info.distortion_model,
          info.D};
}

/// Collects the values of some depth images.
class DepthSampler {
 public:
  explicit DepthSampler(std::size_t images) : step_(std::max<std::size_t>(1, images / kDepthSamples)) {}

  void add(const sensor_msgs::Image& image) {
    if (seen_++ % step_ != 0 || isMalformed(image)) return;
    cv::Mat raw, depth;
    try {
      raw = depthFromMessage(image);
    } catch (const std::invalid_argument&) {  // another check finds wrong encodings
    }
    if (raw.empty() || raw.channels() != 1) return;
    raw.convertTo(depth, CV_32F);
    ++images_;
    for (std::size_t i = 0; i < depth.total(); i += kPixelStep) {
      const float z = depth.at<float>(static_cast<int>(i) / depth.cols, static_cast<int>(i) % depth.cols);
      ++pixels_;
      if (z > 0.0f && std::isfinite(z)) values_.push_back(z);
    }
  }

  DepthFacts facts() {
    DepthFacts facts;
    facts.images = images_;
    if (values_.empty()) return facts;
    facts.valid_share = static_cast<double>(values_.size()) / static_cast<double>(pixels_);
    const auto middle = values_.begin() + static_cast<std::ptrdiff_t>(values_.size() / 2);
    std::nth_element(values_.begin(), middle, values_.end());
    facts.median = *middle;
    return facts;
  }

 private:
  std::size_t step_, seen_ = 0, images_ = 0, pixels_ = 0;
  std::vector<float> values_;
};

/// Compares colour and depth of some frames.
class ShiftSampler {
 public:
  explicit ShiftSampler(std::size_t images) : step_(std::max<std::size_t>(1, images / kShiftSamples)) {}

  void addColor(const sensor_msgs::ImageConstPtr& image) { compare(color_ = image, depth_); }
  void addDepth(const sensor_msgs::ImageConstPtr& image) { compare(color_, depth_ = image); }
  std::optional<RegistrationShift> shift() const { return estimator_.shift(); }

 private:
  void compare(const sensor_msgs::ImageConstPtr& color, const sensor_msgs::ImageConstPtr& depth) {
    if (!color || !depth || std::abs((color->header.stamp - depth->header.stamp).toSec()) > kSameTime_s)
      return;
    if (seen_++ % step_ != 0) return;
    try {
      cv::Mat1f values;
      depthFromMessage(*depth).convertTo(values, CV_32F);
      estimator_.add(colorFromMessage(*color), values);
    } catch (const std::invalid_argument&) {  // another check finds wrong images
    }
  }

  std::size_t step_, seen_ = 0;
  sensor_msgs::ImageConstPtr color_, depth_;
  RegistrationShiftEstimator estimator_;
};

sensor_msgs::ImageConstPtr addImage(const rosbag::MessageInstance& instance, StreamFacts* stream) {
  sensor_msgs::ImageConstPtr image;
  try {
    image = recordedImage(instance);
  } catch (const std::invalid_argument&) {
    ++stream->malformed;
  }
  if (!image) return nullptr;  // another check finds wrong types
  addTimes(image->header, instance.getTime(), stream);
  ++stream->encodings[image->encoding];
  ++stream->sizes[{static_cast<int>(image->width), static_cast<int>(image->height)}];
  stream->malformed += isMalformed(*image);
  return image;
}

void addInfo(const rosbag::MessageInstance& instance, StreamFacts* stream,
             std::vector<CameraFacts>* cameras) {
  const auto info = instance.instantiate<sensor_msgs::CameraInfo>();
  if (!info) return;
  addTimes(info->header, instance.getTime(), stream);
  const CameraFacts camera = factsOf(*info);
  if (cameras->empty() || !(cameras->back() == camera)) cameras->push_back(camera);
}

}  // namespace

RecordingFacts readFacts(const std::string& path, const CameraTopics& camera,
                         const std::function<void(double)>& progress) try {
  const rosbag::Bag bag = openBag(path);
  RecordingFacts facts;
  facts.path = path;
  rosbag::View everything(bag);
  for (const rosbag::ConnectionInfo* connection : everything.getConnections())
    facts.topics[connection->topic] = connection->datatype;
  const CameraTopics topics = recordedTopics(bag, camera);
  facts.color.topic = topics.color;
  facts.color_info.topic = topics.color_info;
  facts.depth.topic = topics.depth;
  facts.depth_info.topic = topics.depth_info;
  std::vector<std::string> names;
  for (StreamFacts* stream : {&facts.color, &facts.color_info, &facts.depth, &facts.depth_info}) {
    const auto found = facts.topics.find(stream->topic);
    if (found != facts.topics.end()) stream->type = found->second;
    names.push_back(stream->topic);
  }
  const std::size_t depth_images = rosbag::View(bag, rosbag::TopicQuery(facts.depth.topic)).size();
  DepthSampler sampler(depth_images);
  ShiftSampler shift_sampler(depth_images);
  rosbag::View view(bag, rosbag::TopicQuery(names));
  double count = 0.0;
  for (const rosbag::MessageInstance& instance : view) {
    const std::string topic = instance.getTopic();
    if (topic == facts.color.topic) shift_sampler.addColor(addImage(instance, &facts.color));
    if (topic == facts.depth.topic) {
      const sensor_msgs::ImageConstPtr image = addImage(instance, &facts.depth);
      if (image) sampler.add(*image);
      shift_sampler.addDepth(image);
    }
    if (topic == facts.color_info.topic) addInfo(instance, &facts.color_info, &facts.color_cameras);
    if (topic == facts.depth_info.topic) addInfo(instance, &facts.depth_info, &facts.depth_cameras);
    progress(++count / static_cast<double>(view.size()));
  }
  facts.depth_values = sampler.facts();
  facts.shift = shift_sampler.shift();
  return facts;
} catch (const rosbag::BagException& error) {
  throw damagedBag(path, error);
}

}  // namespace softbody::validation
