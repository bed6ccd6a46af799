#include "softbody_recordings/ros/facts_reader.h"

#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/CameraInfo.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/statistics/median.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/recorded_images.h"
#include "softbody_recordings/ros/typed_message.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody::validation {
namespace {

constexpr std::size_t kDepthSamples = 30, kShiftSamples = 20;
constexpr std::size_t kPixelStep = 7;  // every 7th pixel is enough for the median

/// Every k-th of some items, so that about `samples` remain.
class Every {
 public:
  Every(std::size_t items, std::size_t samples) : step_(std::max<std::size_t>(1, items / samples)) {}
  bool next() { return seen_++ % step_ == 0; }

 private:
  std::size_t step_, seen_ = 0;
};

void addTimes(const std_msgs::Header& header, const ros::Time& received, StreamFacts* stream) {
  stream->stamps.push_back(toNanoseconds(header.stamp));
  stream->received.push_back(toNanoseconds(received));
  stream->frame_ids.insert(withoutSlash(header.frame_id));
}

void addCamera(const Pinhole& rectified, const Distortion& distortion, std::vector<CameraFacts>* cameras) {
  const cv::Matx33d& K = distortion.K;
  CameraFacts camera{rectified.width, rectified.height, rectified.fx,
                     rectified.fy,    rectified.cx,     rectified.cy};
  if (K(0, 0) > 0.0) camera = {rectified.width, rectified.height, K(0, 0), K(1, 1), K(0, 2), K(1, 2)};
  if (cameras->empty() || !(cameras->back() == camera)) cameras->push_back(camera);
}

/// Collects the values of some depth images.
class DepthSampler {
 public:
  explicit DepthSampler(std::size_t images) : every_(images, kDepthSamples) {}

  void add(const CameraImages& frame) {
    if (!every_.next()) return;
    cv::Mat1f depth;
    frame.depth.convertTo(depth, CV_32F);
    unit_m_ = unitOf(frame);
    ++images_;
    for (std::size_t i = 0; i < depth.total(); i += kPixelStep) {
      const float z = depth(static_cast<int>(i) / depth.cols, static_cast<int>(i) % depth.cols);
      ++pixels_;
      const double metres = unit_m_ * z;
      usable_ += metres >= range_.min_depth_m && metres <= range_.max_depth_m;
      if (z > 0.0f && std::isfinite(z)) values_.push_back(z);
    }
  }

  DepthFacts facts() {
    DepthFacts facts;
    facts.images = images_;
    facts.unit_m = unit_m_;
    if (values_.empty()) return facts;
    facts.valid_share = static_cast<double>(values_.size()) / static_cast<double>(pixels_);
    facts.usable_share = static_cast<double>(usable_) / static_cast<double>(pixels_);
    facts.median = median(&values_);
    return facts;
  }

 private:
  Every every_;
  CameraIngestConfig range_;
  double unit_m_ = 0.001;
  std::size_t images_ = 0, pixels_ = 0, usable_ = 0;
  std::vector<float> values_;
};

/// Compares colour and depth of some frames.
class ShiftSampler {
 public:
  explicit ShiftSampler(std::size_t images) : every_(images, kShiftSamples), ingest_(everything()) {}

  void add(const CameraImages& images) {
    if (!every_.next()) return;
    const RgbdFrame frame = ingest_.process(images);
    estimator_.add(frame.color, frame.depth);
  }
  std::optional<RegistrationShift> shift() const { return estimator_.shift(); }

 private:
  static CameraIngestConfig everything() {
    CameraIngestConfig config;
    config.keep_all_depth = true;
    return config;
  }

  Every every_;
  CameraIngest ingest_;
  RegistrationShiftEstimator estimator_;
};

class FactsReader {
 public:
  FactsReader(const std::string& path, const rosbag::Bag& bag, const CameraTopics& topics) {
    facts_.path = path;
    facts_.color.topic = topics.color;
    facts_.color_info.topic = topics.color_info;
    facts_.depth.topic = topics.depth;
    facts_.depth_info.topic = topics.depth_info;
    rosbag::View everything(bag);
    for (const rosbag::ConnectionInfo* connection : everything.getConnections()) addConnection(*connection);
  }

  /// Whether the topics hold what their names say.
  bool readable() const {
    for (const StreamFacts* stream : {&facts_.color, &facts_.color_info, &facts_.depth})
      if (!stream->present()) return false;
    for (const StreamFacts* stream : {&facts_.color, &facts_.color_info, &facts_.depth, &facts_.depth_info})
      if (!stream->type_fault.empty()) return false;
    return true;
  }

  void readFrames(const rosbag::Bag& bag, const BagFramesConfig& config,
                  const std::function<void(double)>& progress) {
    const std::size_t depth_images = rosbag::View(bag, rosbag::TopicQuery(facts_.depth.topic)).size();
    DepthSampler depths(depth_images);
    ShiftSampler shifts(depth_images);
    BagFramesUse use;
    use.note = [this](const std::string& sentence) { facts_.frames.notes.push_back(sentence); };
    use.message = [this](const auto& message, const auto* image) { addMessage(message, image); };
    use.frame = [&](const CameraImages& images, const std_msgs::Header&, double share) {
      addCamera(images.rectified, images.distortion, &facts_.color_cameras);
      if (images.depth_camera)
        addCamera(images.depth_camera->rectified, images.depth_camera->distortion, &facts_.depth_cameras);
      if (!images.depth.empty()) {
        depths.add(images);
        shifts.add(images);
      }
      progress(share);
    };
    const BagFramesReport report = readBagImages(bag, config, use);
    facts_.frames.frames = report.frames;
    facts_.frames.with_depth = report.withDepth();
    facts_.frames.unusable = report.reasons;
    facts_.depth_values = depths.facts();
    facts_.shift = shifts.shift();
  }

  RecordingFacts take() { return std::move(facts_); }

 private:
  void addConnection(const rosbag::ConnectionInfo& connection) {
    facts_.topics[connection.topic] = connection.datatype;
    const auto use = [&connection](const std::string& fault, StreamFacts* stream) {
      if (stream->topic != connection.topic) return;
      stream->type = connection.datatype;
      if (!fault.empty()) stream->type_fault = fault;
    };
    for (StreamFacts* stream : {&facts_.color, &facts_.depth}) use(imageTypeFault(connection), stream);
    for (StreamFacts* stream : {&facts_.color_info, &facts_.depth_info})
      use(infoTypeFault(connection), stream);
  }

  void addMessage(const rosbag::MessageInstance& message, const sensor_msgs::Image* image) {
    const std::string& topic = message.getTopic();
    if (image != nullptr) {
      StreamFacts* stream = topic == facts_.color.topic ? &facts_.color : &facts_.depth;
      addTimes(image->header, message.getTime(), stream);
      ++stream->encodings[image->encoding];
      ++stream->sizes[{static_cast<int>(image->width), static_cast<int>(image->height)}];
    } else if (topic == facts_.color_info.topic || topic == facts_.depth_info.topic) {
      StreamFacts* stream = topic == facts_.color_info.topic ? &facts_.color_info : &facts_.depth_info;
      const auto info = message.instantiate<sensor_msgs::CameraInfo>();
      if (info) addTimes(info->header, message.getTime(), stream);
    }
  }

  RecordingFacts facts_;
};

}  // namespace

RecordingFacts readFacts(const std::string& path, const BagFramesConfig& config,
                         const std::function<void(double)>& progress) try {
  const rosbag::Bag bag = openBag(path);
  FactsReader reader(path, bag, recordedTopics(bag, config.camera));
  if (reader.readable()) reader.readFrames(bag, config, progress);
  return reader.take();
} catch (const rosbag::BagException& error) {
  throw damagedBag(path, error);
}

}  // namespace softbody::validation
