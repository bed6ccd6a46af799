#include "ros/identification/seen_frames.h"

#include <fmt/format.h>
#include <geometry_msgs/WrenchStamped.h>
#include <rosbag/view.h>

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "ros/replay/camera_poses.h"
#include "ros/replay/recorded_surroundings.h"
#include "softbody_common/images/object_texture.h"
#include "softbody_common/protocol/tracking_state.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/time.h"
#include "softbody_common/time/time.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/typed_message.h"

namespace softbody {
namespace {

using Warn = std::function<void(const std::string&)>;

/// Fingers touch only what the gripper holds.
bool isFinger(const std::string& obstacle) { return obstacle.rfind("gripper_finger_", 0) == 0; }

NamedSurroundings withoutFingers(const NamedSurroundings& around) {
  NamedSurroundings kept = around;
  kept.all.obstacles.clear();
  kept.obstacles.clear();
  for (std::size_t k = 0; k < around.obstacles.size(); ++k) {
    if (isFinger(around.obstacles[k])) continue;
    kept.all.obstacles.push_back(around.all.obstacles[k]);
    kept.obstacles.push_back(around.obstacles[k]);
  }
  return kept;
}

/// Pins, gripper and obstacles of the recording. They do not act on the tracked body: what it does has to
/// come from the images alone.
class Followed {
 public:
  Followed(const SurroundingsConfig& config, const std::vector<PinRegion>& pins, const ObjectModel& model)
      : gripper_(config.gripper),
        volume_(model.volume),
        follower_(config.pin_accuracy_m, {model.visual, model.volume}) {
    for (const ObstacleDescription& obstacle : config.obstacles) follower_.setObstacle(obstacle);
    for (const PinRegion& pin : pins) follower_.addPin(pin, volume_);
  }

  NamedSurroundings at(Nanoseconds stamp, const SurroundingsInput& input, const Points& vertices) {
    if (gripper_ && input.gripper_closed && input.gripper_closed != closed_) {
      closed_ = input.gripper_closed;
      if (*closed_)
        follower_.grip(*gripper_, input.lookup, volume_, vertices, stamp);
      else
        follower_.removePin(gripper_->name);
    }
    follower_.surroundingsAt(stamp, input.lookup, vertices, stamp);
    return withoutFingers(follower_.lastSurroundings());
  }
  void forget() { follower_.forgetPinPositions(); }
  std::vector<std::string> faults() const {
    std::vector<std::string> sentences;
    for (const auto& [name, fault] : follower_.faults()) sentences.push_back(fault);
    return sentences;
  }

 private:
  std::optional<PinRegion> gripper_;
  std::optional<bool> closed_;
  TetTopology volume_;  ///< uncut
  SurroundingsFollower follower_;
};

/// What the tracker says of one frame; empty if it does not see the uncut body.
std::optional<SeenFrame> seen(const FrameOutput& output, Nanoseconds stamp) {
  const TargetSet& targets = output.tracking.targets;
  if (!output.tracking.has_targets || !output.volume || targets.revision != 0 ||
      output.tracking.status.state != TrackingState::kTracking)
    return std::nullopt;
  SeenFrame frame{stamp, {}, output.volume->vertices, {}};
  for (const Target& target : targets.targets)
    if (target.kind != TargetKind::kPrior) frame.targets.push_back(target);
  return frame;
}

/// @param warn of samples that tf does not place.
WrenchRecord readWrenches(const rosbag::Bag& bag, const WrenchTopic& topic, double least_std_n,
                          const FrameLookup& lookup, const Warn& warn) {
  WrenchRecord record{topic.at, topic.topic, least_std_n, {}, false};
  std::string unplaced;
  std::size_t left_out = 0;
  rosbag::View view(bag, rosbag::TopicQuery(topic.topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instantiate<geometry_msgs::WrenchStamped>(instance, bag);
    const std::string frame = withoutSlash(message->header.frame_id);
    if (frame.empty())
      throw std::invalid_argument(
          fmt::format("{}: {} has no frame_id, so the direction of its forces is not known: set it where the "
                      "sensor's driver is configured",
                      bag.getFileName(), topic.topic));
    const auto pose = lookup(frame, toNanoseconds(message->header.stamp));
    if (!pose) {
      unplaced = frame, ++left_out;
      continue;
    }
    const auto vector = [](const geometry_msgs::Vector3& v) { return Eigen::Vector3d(v.x, v.y, v.z); };
    const Eigen::Matrix3d turn = pose->pose.linear();
    record.samples.push_back({toNanoseconds(message->header.stamp),
                              pose->pose.translation(),
                              {turn * vector(message->wrench.force), turn * vector(message->wrench.torque)}});
  }
  if (!record.samples.empty()) {
    if (left_out > 0)
      warn(fmt::format("{}: {} of {} messages are left out: tf has no pose of {} at their stamps",
                       topic.topic, left_out, left_out + record.samples.size(), unplaced));
    return record;
  }
  throw std::invalid_argument(
      unplaced.empty() ? fmt::format("{} has no message on {} (geometry_msgs/WrenchStamped)",
                                     bag.getFileName(), topic.topic)
                       : fmt::format("{}: tf does not connect frame {} of {} with the camera: record it",
                                     bag.getFileName(), unplaced, topic.topic));
}

/// The fixed frame: as asked for, as the parameters say, or `world` if the bag knows it.
std::string fixedFrame(const RecordingQuestion& question, const GraphConfig& config) {
  if (!question.frame.empty()) return withoutSlash(question.frame);
  if (!config.output_frame.empty()) return withoutSlash(config.output_frame);
  const BagTransforms transforms({question.recording});
  return transforms.has("world") ? "world" : "";
}

/// Tracks the body through a bag. @param camera_frame gets that of the images.
std::vector<SeenFrame> track(const RecordingQuestion& question, const GraphConfig& config,
                             const rosbag::Bag& bag, const RecordedSurroundings& surroundings,
                             const std::string& fixed_frame, Pipeline* pipeline, Followed* followed,
                             const BagFramesUse& messages, std::string* camera_frame) {
  const CameraPoses poses(question.recording, fixed_frame);
  CameraIngest ingest(config.ingest);
  std::vector<SeenFrame> seen_frames;
  std::string reason;
  std::optional<Nanoseconds> first;
  BagFramesUse use = messages;
  use.frame = [&](const CameraImages& images, const std_msgs::Header& header, double share) {
    messages.frame(images, header, share);
    *camera_frame = header.frame_id;
    RgbdFrame frame = ingest.process(images);
    frame.T_fixed_camera = poses.of(header);
    const FrameOutput output = pipeline->process(frame);
    reason = output.tracking.status.reason;
    if (!first) first = frame.stamp;
    const double time_s = seconds(frame.stamp - *first);
    auto now = seen(output, frame.stamp);
    if (time_s < question.from_s || time_s > question.to_s || !now) return;
    if (output.tracking.targets.reset) followed->forget();
    const std::string& fixed = fixed_frame.empty() ? header.frame_id : fixed_frame;
    now->around = followed->at(frame.stamp, surroundings.at(fixed, header.stamp), now->vertices);
    seen_frames.push_back(std::move(*now));
  };
  BagFramesConfig frames{question.camera, config.pairing};
  if (frames.camera.depth_scale == 0.0) frames.camera.depth_scale = config.depth_scale;
  readBagImages(bag, frames, use);
  if (seen_frames.empty())
    throw std::runtime_error(
        fmt::format("{}: the body is tracked in no image of the used part: {}", question.recording, reason));
  return seen_frames;
}

}  // namespace

SeenRecording readRecording(const RecordingQuestion& question, const GraphConfig& config,
                            const ObjectModel& model, const std::vector<PinRegion>& pins, const Warn& warn,
                            const std::function<void(double)>& progress) {
  const rosbag::Bag bag = openBag(question.recording);
  PipelineConfig pipeline_config = config.pipeline;
  pipeline_config.surroundings = {};
  Pipeline pipeline(model, pipeline_config);
  Followed followed(config.pipeline.surroundings, pins, model);
  const RecordedSurroundings surroundings(bag, config.pipeline.surroundings, warn);
  BagFramesUse messages;
  messages.note = warn;
  messages.frame = [&progress](const CameraImages&, const std_msgs::Header&, double share) {
    progress(share);
  };
  SeenRecording recording{fixedFrame(question, config), {}, {}};
  std::string camera_frame;
  recording.frames = track(question, config, bag, surroundings, recording.frame, &pipeline, &followed,
                           messages, &camera_frame);
  for (const std::string& fault : followed.faults()) warn(fault);
  const std::string& fixed = recording.frame.empty() ? camera_frame : recording.frame;
  const FrameLookup lookup = surroundings.at(fixed, ros::Time()).lookup;
  for (const WrenchTopic& topic : question.wrenches)
    recording.wrenches.push_back(readWrenches(bag, topic, question.wrench_std_n, lookup, warn));
  return recording;
}

}  // namespace softbody
