#include "softbody_bringup/bag_frames.h"

#include <fmt/format.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <set>
#include <stdexcept>

#include "softbody_bringup/frame_pairer.h"
#include "softbody_common/conversions.h"
#include "softbody_common/topics.h"
#include "softbody_tracking/conversions.h"

namespace softbody {
namespace {

/// "camera/color/image_raw" in a camera namespace such as "/camera".
std::string cameraTopic(const std::string& camera, const std::string& relative) {
  return camera + relative.substr(relative.find('/'));
}

void requireTopics(const rosbag::Bag& bag, const std::vector<std::string>& topics) {
  rosbag::View view(bag);
  std::set<std::string> present;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) present.insert(connection->topic);
  for (const std::string& topic : topics) {
    if (present.count(topic) == 0) {
      throw std::invalid_argument(
          fmt::format("{} has no topic {}; it has: {}", bag.getFileName(), topic, fmt::join(present, ", ")));
    }
  }
}

class Reader {
 public:
  Reader(const BagFramesConfig& config, CameraIngest* ingest,
         const std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>& use)
      : ingest_(ingest), use_(use), pairer_(config.sync_tolerance) {}

  void add(const rosbag::MessageInstance& message, const std::string& color, const std::string& info,
           const std::string& depth) {
    if (message.getTopic() == info) {
      const auto camera_info = message.instantiate<sensor_msgs::CameraInfo>();
      if (camera_info) info_ = camera_info;
    } else if (message.getTopic() == color || message.getTopic() == depth) {
      const auto image = message.instantiate<sensor_msgs::Image>();
      if (!image) {
        throw std::invalid_argument(fmt::format("{} holds {}; it must be sensor_msgs/Image",
                                                message.getTopic(), message.getDataType()));
      }
      const Nanoseconds stamp = toNanoseconds(image->header.stamp);
      message.getTopic() == color ? pairer_.addColor(stamp, image) : pairer_.addDepth(stamp, image);
    }
  }

  void drain(bool finish, double progress) {
    // Nothing can be rectified before the first CameraInfo; it may come after the first images.
    if (!info_) return;
    while (const auto pair = pairer_.next(finish)) process(*pair, progress);
  }

  const BagFramesReport& report() const { return report_; }
  bool hasInfo() const { return info_ != nullptr; }

 private:
  using Pairer = FramePairer<sensor_msgs::ImageConstPtr, sensor_msgs::ImageConstPtr>;

  void process(const Pairer::Pair& pair, double progress) {
    ++report_.frames;
    if (!pair.depth) ++report_.without_depth;
    RgbdFrame frame;
    try {
      frame = frameFromMessages(*pair.color, pair.depth.get(), *info_, ingest_);
    } catch (const std::invalid_argument& error) {
      ++report_.unusable;
      report_.last_error = error.what();
      return;
    }
    use_(frame, pair.color->header, progress);
  }

  CameraIngest* ingest_;
  const std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>& use_;
  Pairer pairer_;
  sensor_msgs::CameraInfoConstPtr info_;
  BagFramesReport report_;
};

}  // namespace

BagFramesReport readBagFrames(
    const rosbag::Bag& bag, const BagFramesConfig& config, CameraIngest* ingest,
    const std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>& use) {
  const std::string color = cameraTopic(config.camera, topics::kCameraColor);
  const std::string info = cameraTopic(config.camera, topics::kCameraColorInfo);
  const std::string depth = cameraTopic(config.camera, topics::kCameraDepth);
  requireTopics(bag, {color, info, depth});
  rosbag::View view(bag, rosbag::TopicQuery({color, info, depth}));
  Reader reader(config, ingest, use);
  const double total = view.size();
  double count = 0.0;
  for (const rosbag::MessageInstance& message : view) {
    reader.add(message, color, info, depth);
    reader.drain(false, ++count / total);
  }
  if (!reader.hasInfo())
    throw std::invalid_argument(fmt::format("{} is not a sensor_msgs/CameraInfo topic", info));
  reader.drain(true, 1.0);
  return reader.report();
}

}  // namespace softbody
