#include "softbody_recordings/ros/bag_frames.h"

#include <fmt/format.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <set>
#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/topics.h"
#include "softbody_tracking/camera/frame_pairer.h"
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
          fmt::format("{} has no topic {}; it has: {}; record it, or rename one of these", bag.getFileName(),
                      topic, fmt::join(present, ", ")));
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

struct CameraTopics {
  std::string color, info, depth;
};

class Reader {
 public:
  using Use = std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>;

  Reader(const PairingConfig& pairing, CameraTopics topics, CameraIngest* ingest, const Use& use)
      : topics_(std::move(topics)), ingest_(ingest), use_(use), pairer_(pairing) {}

  void add(const rosbag::MessageInstance& message) {
    if (message.getTopic() == topics_.info)
      return pairer_.setInfo(instantiate<sensor_msgs::CameraInfo>(message, "sensor_msgs/CameraInfo"));
    const auto image = instantiate<sensor_msgs::Image>(message, "sensor_msgs/Image");
    const Nanoseconds stamp = toNanoseconds(image->header.stamp);
    if (message.getTopic() == topics_.color)
      pairer_.addColor(stamp, image);
    else
      pairer_.addDepth(stamp, image);
  }

  void processCompleteFrames(bool finish, double progress) {
    while (const auto frame = pairer_.next(finish)) process(*frame, progress);
  }

  BagFramesReport report() const {
    BagFramesReport report = report_;
    report.unpaired = pairer_.unpaired();
    return report;
  }

 private:
  using Pairer =
      FramePairer<sensor_msgs::ImageConstPtr, sensor_msgs::ImageConstPtr, sensor_msgs::CameraInfoConstPtr>;

  void process(const Pairer::Frame& images, double progress) {
    ++report_.frames;
    if (!images.depth) ++report_.without_depth;
    RgbdFrame frame;
    try {
      frame = frameFromMessages(*images.color, images.depth.get(), *images.info, ingest_);
    } catch (const std::exception& error) {
      ++report_.unusable;
      report_.last_error = error.what();
      return;
    }
    frame.pass = images.pass;
    use_(frame, images.color->header, progress);
  }

  CameraTopics topics_;
  CameraIngest* ingest_;
  const Use& use_;
  Pairer pairer_;
  BagFramesReport report_;
};

}  // namespace

BagFramesReport readBagFrames(
    const rosbag::Bag& bag, const BagFramesConfig& config, CameraIngest* ingest,
    const std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>& use) {
  const CameraTopics topics{cameraTopic(config.camera, topics::kCameraColor),
                            cameraTopic(config.camera, topics::kCameraColorInfo),
                            cameraTopic(config.camera, topics::kCameraDepth)};
  requireTopics(bag, {topics.color, topics.info, topics.depth});
  if (rosbag::View(bag, rosbag::TopicQuery(topics.info)).size() == 0)
    throw std::invalid_argument(fmt::format("{}: {} has no message; record it together with the images",
                                            bag.getFileName(), topics.info));
  rosbag::View view(bag, rosbag::TopicQuery({topics.color, topics.info, topics.depth}));
  Reader reader(config.pairing, topics, ingest, use);
  const double total = view.size();
  double count = 0.0;
  for (const rosbag::MessageInstance& message : view) {
    reader.add(message);
    reader.processCompleteFrames(false, ++count / total);
  }
  reader.processCompleteFrames(true, 1.0);
  return reader.report();
}

}  // namespace softbody
