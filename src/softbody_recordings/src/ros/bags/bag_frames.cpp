#include "softbody_recordings/ros/bag_frames.h"

#include <fmt/format.h>
#include <sensor_msgs/CameraInfo.h>

#include <optional>
#include <set>
#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_recordings/ros/bag_transforms.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/recorded_images.h"
#include "softbody_recordings/ros/typed_message.h"
#include "softbody_tracking/ros/camera_reader.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
namespace {

void requireTopics(const rosbag::Bag& bag, const CameraTopics& topics) {
  rosbag::View view(bag);
  std::set<std::string> present;
  for (const rosbag::ConnectionInfo* connection : view.getConnections()) {
    const std::string& topic = connection->topic;
    present.insert(topic);
    const bool is_image = topic == topics.color || topic == topics.depth;
    if (!is_image && topic != topics.color_info && topic != topics.depth_info) continue;
    const std::string fault = is_image ? imageTypeFault(*connection) : infoTypeFault(*connection);
    if (!fault.empty())
      throw std::invalid_argument(fmt::format("{}: {} {}", bag.getFileName(), topic, fault));
  }
  for (const std::string& topic : {topics.color, topics.color_info, topics.depth}) {
    if (present.count(topic) == 0) {
      throw std::invalid_argument(fmt::format(
          "{} has no topic {}; it has: {}; record it, or name one of these (--color, --depth, --color-info)",
          bag.getFileName(), topic, fmt::join(present, ", ")));
    }
  }
}

/// Null: the bag has none.
sensor_msgs::CameraInfoConstPtr firstInfo(const rosbag::Bag& bag, const std::string& topic) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  if (view.size() == 0) return nullptr;
  return instantiate<sensor_msgs::CameraInfo>(*view.begin(), bag);
}

class Reader {
 public:
  Reader(const rosbag::Bag& bag, const PairingConfig& pairing, const CameraTopics& topics,
         const BagFramesUse& use)
      : bag_(bag),
        topics_(topics),
        use_(use),
        depth_info_(firstInfo(bag, topics.depth_info)),
        pairer_(pairing),
        camera_(
            {topics.color, topics.depth, topics.depth_scale},
            [this](const auto& target, const auto& source, const auto& stamp) {
              return transforms().at(target, source, stamp);
            },
            use.note) {
    const sensor_msgs::CameraInfoConstPtr info = firstInfo(bag, topics.color_info);
    if (!info)
      throw std::invalid_argument(fmt::format("{}: {} has no message; record it together with the images",
                                              bag.getFileName(), topics.color_info));
    pairer_.setInfo(info);
  }

  void add(const rosbag::MessageInstance& message) {
    const std::string& topic = message.getTopic();
    sensor_msgs::ImageConstPtr image;
    if (topic == topics_.depth_info) {
      depth_info_ = instantiate<sensor_msgs::CameraInfo>(message, bag_);
    } else if (topic == topics_.color_info) {
      pairer_.setInfo(instantiate<sensor_msgs::CameraInfo>(message, bag_));
    } else {
      image = imageOf(message);
    }
    use_.message(message, image.get());
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

  const BagTransforms& transforms() {
    if (!transforms_) transforms_.emplace(std::vector<std::string>{bag_.getFileName()});
    return *transforms_;
  }

  void count(const std::string& error, int number) {
    validation::Unusable& unusable =
        report_.reasons.try_emplace(error, validation::Unusable{0, number}).first->second;
    ++unusable.count;
    report_.last_error = error;
  }

  /// Null if the image is damaged.
  sensor_msgs::ImageConstPtr imageOf(const rosbag::MessageInstance& message) {
    const int number = images_[message.getTopic()]++;
    try {
      return recordedImage(message, bag_);
    } catch (const std::invalid_argument& error) {
      ++report_.undecoded;
      count(error.what(), number);
      return nullptr;
    }
  }

  void process(const Pairer::Frame& frame, double progress) {
    const int number = report_.frames++;
    CameraImages images;
    try {
      images = camera_.read({*frame.color, frame.depth.get(), *frame.info, depth_info_.get()});
    } catch (const std::exception& error) {
      ++report_.unusable;
      return count(error.what(), number);
    }
    if (!frame.depth) ++report_.without_depth;
    images.pass = frame.pass;
    std_msgs::Header header = frame.color->header;
    header.frame_id = withoutSlash(header.frame_id);
    use_.frame(images, header, progress);
  }

  const rosbag::Bag& bag_;
  CameraTopics topics_;
  const BagFramesUse& use_;
  sensor_msgs::CameraInfoConstPtr depth_info_;
  std::optional<BagTransforms> transforms_;  ///< only if depth has its own frame
  Pairer pairer_;
  CameraReader camera_;
  std::map<std::string, int> images_;  ///< read so far, by topic
  BagFramesReport report_;
};

}  // namespace

BagFramesReport readBagImages(const rosbag::Bag& bag, const BagFramesConfig& config,
                              const BagFramesUse& use) try {
  const CameraTopics topics = recordedTopics(bag, config.camera);
  requireTopics(bag, topics);
  rosbag::View view(bag,
                    rosbag::TopicQuery({topics.color, topics.color_info, topics.depth, topics.depth_info}));
  Reader reader(bag, config.pairing, topics, use);
  const double total = view.size();
  double count = 0.0;
  for (const rosbag::MessageInstance& message : view) {
    reader.add(message);
    reader.processCompleteFrames(false, ++count / total);
    if (use.enough()) return reader.report();
  }
  reader.processCompleteFrames(true, 1.0);
  return reader.report();
} catch (const rosbag::BagException& error) {
  throw damagedBag(bag.getFileName(), error);
}

BagFramesReport readBagFrames(
    const rosbag::Bag& bag, const BagFramesConfig& config, CameraIngest* ingest,
    const std::function<void(const RgbdFrame&, const std_msgs::Header&, double)>& use,
    const std::function<void(const std::string&)>& note) {
  BagFramesUse through_ingest;
  through_ingest.note = note;
  through_ingest.frame = [&](const CameraImages& images, const std_msgs::Header& header, double progress) {
    use(ingest->process(images), header, progress);
  };
  return readBagImages(bag, config, through_ingest);
}

}  // namespace softbody
