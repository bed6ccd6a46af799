#include "softbody_recordings/ros/bag_frames.h"

#include <fmt/format.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <set>
#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/topics.h"
#include "softbody_recordings/pairing/frame_pairer.h"
#include "softbody_tracking/ros/conversions.h"

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

template <typename Message>
boost::shared_ptr<const Message> instantiate(const rosbag::MessageInstance& instance, const char* type) {
  boost::shared_ptr<const Message> message = instance.instantiate<Message>();
  if (!message) {
    throw std::invalid_argument(
        fmt::format("{} holds {}; it must be {}", instance.getTopic(), instance.getDataType(), type));
  }
  return message;
}

/// The first CameraInfo, since images may come before it.
sensor_msgs::CameraInfoConstPtr firstInfo(const rosbag::Bag& bag, const std::string& topic) {
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic))) {
    return instantiate<sensor_msgs::CameraInfo>(message, "sensor_msgs/CameraInfo");
  }
  throw std::invalid_argument(fmt::format("{} has no message", topic));
}

class Reader {
 public:
  Reader(const BagFramesConfig& config, sensor_msgs::CameraInfoConstPtr info, CameraIngest* ingest,
         const std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>& use)
      : ingest_(ingest), use_(use), pairer_(config.sync_tolerance), info_(std::move(info)) {}

  void add(const rosbag::MessageInstance& message, const std::string& color, const std::string& info,
           const std::string& depth) {
    if (message.getTopic() == info) {
      info_ = instantiate<sensor_msgs::CameraInfo>(message, "sensor_msgs/CameraInfo");
    } else if (message.getTopic() == color || message.getTopic() == depth) {
      const auto image = instantiate<sensor_msgs::Image>(message, "sensor_msgs/Image");
      const Nanoseconds stamp = toNanoseconds(image->header.stamp);
      message.getTopic() == color ? pairer_.addColor(stamp, image) : pairer_.addDepth(stamp, image);
    }
  }

  void drain(bool finish, double progress) {
    while (const auto pair = pairer_.next(finish)) process(*pair, progress);
  }

  BagFramesReport report() const {
    BagFramesReport report = report_;
    report.left_out = pairer_.leftOut();
    return report;
  }

 private:
  using Pairer = FramePairer<sensor_msgs::ImageConstPtr, sensor_msgs::ImageConstPtr>;

  void process(const Pairer::Pair& pair, double progress) {
    ++report_.frames;
    if (!pair.depth) ++report_.without_depth;
    RgbdFrame frame;
    try {
      if (pair.stamp <= 0) throw std::invalid_argument("an image without a stamp");
      frame = frameFromMessages(*pair.color, pair.depth.get(), *info_, ingest_);
    } catch (const std::exception& error) {
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
  Reader reader(config, firstInfo(bag, info), ingest, use);
  const double total = view.size();
  double count = 0.0;
  for (const rosbag::MessageInstance& message : view) {
    reader.add(message, color, info, depth);
    reader.drain(false, ++count / total);
  }
  reader.drain(true, 1.0);
  return reader.report();
}

}  // namespace softbody
