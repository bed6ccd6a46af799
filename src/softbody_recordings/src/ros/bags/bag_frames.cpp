#include "softbody_recordings/ros/bag_frames.h"

#include <fmt/format.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include <optional>
#include <set>
#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_recordings/ros/bag_transforms.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/recorded_images.h"
#include "softbody_tracking/camera/frame_pairer.h"
#include "softbody_tracking/ros/conversions.h"
#include "softbody_tracking/ros/unregistered_depth.h"

namespace softbody {
namespace {

void requireTopics(const rosbag::Bag& bag, const std::vector<std::string>& topics) {
  rosbag::View view(bag);
  std::set<std::string> present;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) present.insert(connection->topic);
  for (const std::string& topic : topics) {
    if (present.count(topic) == 0) {
      throw std::invalid_argument(fmt::format(
          "{} has no topic {}; it has: {}; record it, or name one of these (--color, --depth, --color-info)",
          bag.getFileName(), topic, fmt::join(present, ", ")));
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

class Reader {
 public:
  using Use = std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>;

  Reader(const std::string& bag, const PairingConfig& pairing, CameraTopics topics, CameraIngest* ingest,
         const Use& use)
      : bag_(bag), topics_(std::move(topics)), ingest_(ingest), use_(use), pairer_(pairing) {}

  void add(const rosbag::MessageInstance& message) {
    const std::string& topic = message.getTopic();
    if (topic == topics_.depth_info) {
      depth_info_ = instantiate<sensor_msgs::CameraInfo>(message, "sensor_msgs/CameraInfo");
      return;
    }
    if (topic == topics_.color_info)
      return pairer_.setInfo(instantiate<sensor_msgs::CameraInfo>(message, "sensor_msgs/CameraInfo"));
    const sensor_msgs::ImageConstPtr image = imageOf(message);
    if (!image) return;
    const Nanoseconds stamp = toNanoseconds(image->header.stamp);
    if (topic == topics_.color)
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

  /// Null if the image is damaged. @throw std::invalid_argument if the message has another type.
  sensor_msgs::ImageConstPtr imageOf(const rosbag::MessageInstance& message) {
    sensor_msgs::ImageConstPtr image;
    try {
      image = recordedImage(message);
    } catch (const std::invalid_argument& error) {
      ++report_.undecoded;
      report_.last_error = error.what();
      return nullptr;
    }
    if (!image) {
      throw std::invalid_argument(fmt::format("{} holds {}; it must be sensor_msgs/Image or CompressedImage",
                                              message.getTopic(), message.getDataType()));
    }
    return image;
  }

  std::optional<DepthCamera> depthCamera(const Pairer::Frame& images) {
    const auto lookup = [this](const std::string& target, const std::string& source, const ros::Time& stamp) {
      if (!transforms_) transforms_.emplace(std::vector<std::string>{bag_});
      return transforms_->at(target, source, stamp);
    };
    return unregisteredDepthCamera(*images.color, *images.depth, *images.info, depth_info_.get(), lookup);
  }

  void process(const Pairer::Frame& images, double progress) {
    ++report_.frames;
    if (!images.depth) ++report_.without_depth;
    RgbdFrame frame;
    try {
      std::optional<DepthCamera> depth_camera;
      if (images.depth) depth_camera = depthCamera(images);
      frame = frameFromMessages(*images.color, images.depth.get(), *images.info, ingest_,
                                depth_camera ? &*depth_camera : nullptr);
    } catch (const std::exception& error) {
      ++report_.unusable;
      report_.last_error = error.what();
      return;
    }
    frame.pass = images.pass;
    use_(frame, images.color->header, progress);
  }

  std::string bag_;
  CameraTopics topics_;
  sensor_msgs::CameraInfoConstPtr depth_info_;
  std::optional<BagTransforms> transforms_;  ///< only if depth is not registered
  CameraIngest* ingest_;
  const Use& use_;
  Pairer pairer_;
  BagFramesReport report_;
};

}  // namespace

BagFramesReport readBagFrames(
    const rosbag::Bag& bag, const BagFramesConfig& config, CameraIngest* ingest,
    const std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>& use) try {
  const CameraTopics topics = recordedTopics(bag, config.camera);
  requireTopics(bag, {topics.color, topics.color_info, topics.depth});
  if (rosbag::View(bag, rosbag::TopicQuery(topics.color_info)).size() == 0)
    throw std::invalid_argument(fmt::format("{}: {} has no message; record it together with the images",
                                            bag.getFileName(), topics.color_info));
  rosbag::View view(bag,
                    rosbag::TopicQuery({topics.color, topics.color_info, topics.depth, topics.depth_info}));
  Reader reader(bag.getFileName(), config.pairing, topics, ingest, use);
  const double total = view.size();
  double count = 0.0;
  for (const rosbag::MessageInstance& message : view) {
    reader.add(message);
    reader.processCompleteFrames(false, ++count / total);
  }
  reader.processCompleteFrames(true, 1.0);
  return reader.report();
} catch (const rosbag::BagException& error) {
  throw damagedBag(bag.getFileName(), error);
}

}  // namespace softbody
