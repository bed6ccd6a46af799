#include "softbody_recordings/ros/replay.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>

#include "ros/replay/body_run.h"
#include "ros/replay/camera_poses.h"
#include "ros/replay/recorded_robot.h"
#include "ros/replay/recorded_surface.h"
#include "ros/replay/recorded_surroundings.h"
#include "softbody_common/images/object_texture.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_recordings/ros/graph_config.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/object_namespaces.h"
#include "softbody_recordings/ros/recorded_images.h"
#include "softbody_tracking/depth_unit/depth_unit.h"

namespace softbody {
namespace {

using Warn = std::function<void(const std::string&)>;

void warnAll(const Warn& warn, const std::string& source, const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings)
    warn(source.empty() ? warning : fmt::format("{}: {}", source, warning));
}

ObjectModel loadModel(const ObjectDescription& description, const std::string& object, const Warn& warn) {
  ObjectModel model = buildObjectModel(description);
  warnAll(warn, object, model.warnings);
  return model;
}

std::vector<PinRegion> pinsOf(const ObjectDescription& description) {
  std::vector<PinRegion> pins = description.pins;
  for (PinRegion& pin : pins) pin.frame = withoutSlash(pin.frame);
  return pins;
}

/// The body is tracked without its picture, too.
cv::Mat3b loadPicture(const std::string& object, FileScope scope, const Warn& warn) try {
  return readObjectTexture(object, scope);
} catch (const std::invalid_argument& error) {
  warn(fmt::format("the body is searched for without its picture: {}", error.what()));
  return {};
}

GraphConfig configOf(const ReplayOptions& options, const Warn& warn) {
  std::vector<std::string> warnings;
  GraphConfig config = readGraphConfig(options.parameters, &warnings, options.gripper);
  warnAll(warn, "", warnings);
  config.pipeline.forces = options.forces, config.pipeline.placed = options.placed;
  if (!options.simd.empty()) config.pipeline.simulator.simd = options.simd;
  return config;
}

std::optional<ToolDescription> loadTool(const ReplayOptions& options, const std::string& blade_frame,
                                        const Warn& warn) {
  if (options.tool.empty()) return std::nullopt;
  ToolDescription tool = inFrame(loadToolDescription(options.tool, options.scope),
                                 options.blade_frame.empty() ? blade_frame : options.blade_frame);
  warnAll(warn, "", tool.warnings);
  tool.frame = withoutSlash(tool.frame);
  return tool;
}

/// The cuts of each body. One body must have cuts; of several bodies not every one is cut.
std::vector<CutJournal> loadJournals(const std::string& path, const std::vector<std::string>& namespaces) {
  std::vector<CutJournal> journals(namespaces.size());
  if (path.empty()) return journals;
  const rosbag::Bag bag = openBag(path);
  std::string why;
  std::size_t cuts = 0;
  for (std::size_t k = 0; k < journals.size(); ++k) {
    try {
      journals[k] = {bag, namespaces[k] + "/" + topics::kCut};
    } catch (const std::invalid_argument& error) {
      why = error.what();
    }
    cuts += journals[k].size();
  }
  if (cuts == 0) throw std::invalid_argument(why);
  return journals;
}

/// The bodies of a replay, frame by frame, and the bag with their results.
class Replay {
 public:
  /// @param input must outlive the replay.
  Replay(const ReplayOptions& options, const rosbag::Bag& input, const GraphConfig& config, Warn warn)
      : warn_(std::move(warn)),
        camera_poses_(options.input,
                      options.output_frame.empty() ? config.output_frame : options.output_frame),
        output_(options.output) {
    addBodies(options, config);
    if (!follows_) warnAll(warn_, "", camera_poses_.warnings());
    if (follows_) surroundings_.emplace(input, config.pipeline.surroundings, warn_);
    if (options.known_surfaces.empty() && options.robot.empty()) return;
    transforms_.emplace(std::vector<std::string>{options.input});
    for (const std::string& name : options.known_surfaces) surfaces_.emplace_back(input, name, warn_);
    if (!options.robot.empty()) robot_.emplace(options.robot, config.robot_deviation_m, warn_);
  }

  /// Frames from this number on are predicted.
  void setObservedFrames(std::size_t count) { observed_frames_ = count; }

  void process(RgbdFrame frame, const std_msgs::Header& header) {
    const bool observed = frames_++ < observed_frames_;
    try {
      frame.T_fixed_camera = camera_poses_.of(header);
    } catch (const std::exception& error) {
      for (auto& body : bodies_) body->skip(frame, header, error.what());
      return;
    }
    const SurroundingsInput surroundings = surroundingsAt(header);
    if (!observed) {
      for (auto& body : bodies_) body->predict(frame, header, surroundings);
      return;
    }
    const std::vector<KnownSurface> recorded = recordedSurfaces(frame, header);
    std::vector<std::optional<KnownSurface>> before;  // of the bodies, by their states of the frame before
    for (const auto& body : bodies_) before.push_back(body->surface(frame));
    for (std::size_t k = 0; k < bodies_.size(); ++k) {
      std::vector<KnownSurface> others = recorded;
      for (std::size_t other = 0; other < before.size(); ++other)
        if (other != k && before[other]) others.push_back(*before[other]);
      bodies_[k]->process(frame, header, others, surroundings);
    }
  }

  std::vector<BodySummary> finish() {
    std::vector<BodySummary> summaries;
    for (auto& body : bodies_) summaries.push_back(body->finish());
    output_.finish();
    return summaries;
  }

  const std::vector<std::unique_ptr<BodyRun>>& bodies() const { return bodies_; }

 private:
  SurroundingsInput surroundingsAt(const std_msgs::Header& header) const {
    const std::string& fixed = camera_poses_.outputFrame();
    return surroundings_ ? surroundings_->at(fixed.empty() ? header.frame_id : fixed, header.stamp)
                         : SurroundingsInput();
  }

  /// Of the recording, in the camera's frame.
  std::vector<KnownSurface> recordedSurfaces(const RgbdFrame& frame, const std_msgs::Header& header) {
    std::vector<KnownSurface> known;
    for (RecordedSurface& surface : surfaces_)
      if (auto now = surface.at(frame, header.frame_id, *transforms_, warn_))
        known.push_back(std::move(*now));
    if (!robot_) return known;
    for (KnownSurface& link : robot_->at(header, *transforms_)) known.push_back(std::move(link));
    return known;
  }

  void addBodies(const ReplayOptions& options, const GraphConfig& graph) {
    PipelineConfig config = graph.pipeline;
    const bool alone = options.objects.size() == 1;
    const std::optional<ToolDescription> tool = loadTool(options, graph.blade_frame, warn_);
    follows_ = config.surroundings.gripper || !config.surroundings.obstacles.empty() ||
               (tool && !tool->frame.empty());
    const std::vector<std::string> namespaces =
        alone ? std::vector<std::string>{options.topic_namespace} : objectNamespaces(options.objects);
    std::vector<CutJournal> journals = loadJournals(options.journal, namespaces);
    for (std::size_t k = 0; k < namespaces.size(); ++k) {
      const Warn warn_of_body =
          alone ? warn_ : [warn = warn_, name = namespaces[k]](const std::string& text) {
            warn(fmt::format("{}: {}", name, text));
          };
      config.picture = loadPicture(options.objects[k], options.scope, warn_of_body);
      const ObjectDescription description = loadObjectDescription(options.objects[k], options.scope);
      const ObjectModel model = loadModel(description, options.objects[k], warn_);
      config.pins = pinsOf(description);
      follows_ = follows_ || !config.pins.empty();
      BodyRunSetup setup{namespaces[k],
                         camera_poses_.outputFrame(),
                         {options.timing, options.labels},
                         tool,
                         std::move(journals[k])};
      bodies_.push_back(std::make_unique<BodyRun>(model, config, std::move(setup), &output_, warn_of_body));
    }
  }

  Warn warn_;
  CameraPoses camera_poses_;
  bool follows_ = false;  ///< pins, obstacles, a gripper or a tool follow frames
  std::optional<RecordedSurroundings> surroundings_;
  std::optional<BagTransforms> transforms_;  ///< for known surfaces
  std::vector<RecordedSurface> surfaces_;
  std::optional<RecordedRobot> robot_;
  std::size_t frames_ = 0, observed_frames_ = std::numeric_limits<std::size_t>::max();
  AtomicBag output_;
  std::vector<std::unique_ptr<BodyRun>> bodies_;
};

/// The number of frames before the open loop, at least one.
std::size_t observedFrames(const rosbag::Bag& input, const ReplayOptions& options) {
  rosbag::View images(input, rosbag::TopicQuery(recordedTopics(input, options.camera).color));
  return static_cast<std::size_t>(std::max(1L, std::lround((1.0 - options.open_loop) * images.size())));
}

/// What the user can do if a body was found in no frame.
std::string whyNotFound(const BodyRun& body, const CameraImages& first, CameraIngest* ingest,
                        const TrackerConfig& config) {
  const std::optional<double> unit_m =
      depthUnitThatFits(first, ingest, config, body.volumeTopology(), body.surfaceTopology());
  return body.summary().reasons.begin()->second +
         (unit_m
              ? fmt::format("; depth shows the body in its size if its unit is {} m: set depth_scale to {} "
                            "(--depth-scale {}, or the parameter of camera_ingest)",
                            *unit_m, *unit_m, *unit_m)
              : "");
}

/// Warns about bodies without a surface. @throw std::runtime_error if no body has one.
void requireSurface(const Replay& run, const std::string& input, const Warn& warn,
                    const std::function<std::string(const BodyRun&)>& why) {
  const auto has_surface = [](const auto& body) { return body->summary().states > 0; };
  const bool any = std::any_of(run.bodies().begin(), run.bodies().end(), has_surface);
  for (const auto& body : run.bodies()) {
    if (has_surface(body)) continue;
    if (!any) throw std::runtime_error(fmt::format("no frame of {} gave a surface: {}", input, why(*body)));
    warn(fmt::format("{}: no frame gave a surface: {}", body->summary().topic_namespace, why(*body)));
  }
}

}  // namespace

ReplaySummary replay(const ReplayOptions& options, const Warn& warn,
                     const std::function<void(double)>& progress) {
  const GraphConfig config = configOf(options, warn);
  const rosbag::Bag input = openBag(options.input);
  Replay run(options, input, config, warn);
  if (options.open_loop > 0.0) run.setObservedFrames(observedFrames(input, options));
  CameraIngest ingest(config.ingest);
  BagFramesConfig frames{options.camera, config.pairing};
  if (frames.camera.depth_scale == 0.0) frames.camera.depth_scale = config.depth_scale;
  CameraImages first;  // with depth
  BagFramesUse use;
  use.note = warn;
  use.frame = [&](const CameraImages& images, const std_msgs::Header& header, double share) {
    if (first.depth.empty()) first = images, first.depth = images.depth.clone();
    run.process(ingest.process(images), header);
    progress(share);
  };
  ReplaySummary summary;
  summary.read = readBagImages(input, frames, use);
  if (run.bodies().front()->summary().frames_by_state.empty()) {
    throw std::runtime_error(fmt::format("{} holds no usable frame{}{}", options.input,
                                         summary.read.last_error.empty() ? "" : ": ",
                                         summary.read.last_error));
  }
  requireSurface(run, options.input, warn, [&](const BodyRun& body) {
    return whyNotFound(body, first, &ingest, config.pipeline.tracker);
  });
  summary.bodies = run.finish();
  return summary;
}

}  // namespace softbody
