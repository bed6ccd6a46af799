#include <CLI/CLI.hpp>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "paper/followed_vertices.h"
#include "paper/frame_features.h"
#include "softbody_common/files/input_file.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/images/object_texture.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_recordings/ros/bag_frames.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/result_bag.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/interpolation/visual_surface.h"
#include "softbody_sim/object/object_model.h"
#include "softbody_tracking/known/known_surface.h"
#include "softbody_tracking/tracker/body_tracker.h"

namespace softbody::evaluation {
namespace {

constexpr char kTracking[] = "Feature-Point Tracking", kSimulation[] = "Soft-body Simulation",
               kSurface[] = "Resolution Enhancement";

/// What follows the features: eq. 8-9 of the paper, eq. 10-11, or nothing between them (Figure 6).
enum class Shape { kFem, kProjectiveDynamics, kAlone };

struct Options {
  std::string recording, object, output;
  Shape shape = Shape::kAlone;
  int max_features = 1000;  ///< N_p
  bool own_features = false;
};

/// Without what is not in the paper: no L-BFGS, no smoothed strains, no loads, no memory.
SimulatorConfig simulatorOf(Shape shape) {
  SimulatorConfig config;
  config.load_fade_s = config.memory_s = 0.0;
  if (shape == Shape::kFem) {
    config.solver = SolverKind::kFem;
    config.iterations = 1;
  } else {
    config.lbfgs_history = 0;
    config.strain_smoothing = 0.0;
    config.volume_smoothing = 0.0;
  }
  return config;
}

TrackerConfig trackerOf(const Options& options) {
  TrackerConfig config;
  config.max_features = options.max_features;
  return config;
}

/// Depth of a body in a frame that shows it [m]; 0 elsewhere.
cv::Mat1f depthOf(const TetTopology& volume, const Points& vertices, const RgbdFrame& frame) {
  RgbdFrame shown = frame;
  shown.known.release();
  return withKnownSurfaces(std::move(shown), {{"body", {vertices, volume.surface}, 0.0}}).known;
}

/// The method of Kang et al. 2022 on a recording of a fixed camera. The pose in the first frame is found by
/// our tracker.
class PaperMethod {
 public:
  PaperMethod(const Options& options, const ObjectModel& model)
      : options_(options),
        tracker_(trackerOf(options), readObjectTexture(options.object, FileScope::kOwnFolder)),
        simulator_(makeSimulator(model)),
        surface_(makeSurface(model)),
        places_(static_cast<std::size_t>(model.volume.rest_vertices.rows())),
        bag_(options.output),
        results_(&bag_, "/softbody", {true, false}) {
    for (Eigen::Index t = 0; t < volume().tets.rows(); ++t)
      for (int k = 0; k < 4; ++k)
        places_[static_cast<std::size_t>(volume().tets(t, k))] = {static_cast<int>(t),
                                                                  Eigen::Vector4d::Unit(k)};
    tracker_.setTopologies(volume(), surface_.topology());
  }

  void process(const RgbdFrame& frame, const std_msgs::Header& header) {
    if (frames_++ == 0) results_.writeTopologies(volume(), surface_.topology(), header.stamp);
    FrameOutput output;
    output.image = frame.depth.size();
    output.tracking = simulator_.placed() ? follow(frame) : find(frame);
    if (output.tracking.has_targets) addShape(frame.stamp, &output);
    output.times = timer_.take();
    results_.writeFrame(output, header);
  }

  /// @throw std::runtime_error if no frame shows the body.
  void finish() {
    if (!simulator_.placed())
      throw std::runtime_error("no frame of " + options_.recording + " shows the body");
    bag_.finish();
  }

 private:
  const TetTopology& volume() const { return simulator_.topology(); }

  Simulator makeSimulator(const ObjectModel& model) {
    const auto scope = timer_.stage(kSimulation, true);
    return {model.volume, model.material, simulatorOf(options_.shape)};
  }

  VisualSurface makeSurface(const ObjectModel& model) {
    const auto scope = timer_.stage(kSurface, true);
    return {model.visual, model.volume};
  }

  TrackingResult find(const RgbdFrame& frame) {
    StageTimer unused;
    TrackingResult result = tracker_.track(frame, nullptr, &unused);
    result.targets.targets.clear();
    if (!result.has_targets) return result;
    const auto scope = timer_.stage(kTracking, true);
    first_ = transformed(volume().rest_vertices, result.targets.body_pose);
    if (options_.own_features) return result;
    features_.emplace(options_.max_features, frame, depthOf(volume(), first_, frame));
    vertices_.emplace(features_->all(), volume(), first_);
    return result;
  }

  TrackingResult follow(const RgbdFrame& frame) {
    TrackingResult result = features_ ? followByOrb(frame) : followByTracker(frame);
    result.has_targets = true;
    result.targets = {};
    result.targets.body_pose = fitRigid(volume().rest_vertices, simulator_.state().vertices);
    if (!vertices_) return result;
    for (const MovedVertex& moved : vertices_->moved(result.features)) {
      Target target;
      target.kind = TargetKind::kVertex;
      target.place = places_[static_cast<std::size_t>(moved.vertex)];
      target.position = moved.position;
      result.targets.targets.push_back(target);
    }
    return result;
  }

  TrackingResult followByOrb(const RgbdFrame& frame) {
    const auto scope = timer_.stage(kTracking);
    TrackingResult result;
    result.features = features_->follow(frame);
    result.status.state = TrackingState::kTracking;
    result.status.features_tracked = static_cast<std::uint32_t>(result.features.size());
    result.status.features_total = static_cast<std::uint32_t>(features_->all().size());
    return result;
  }

  TrackingResult followByTracker(const RgbdFrame& frame) {
    TrackingResult result = tracker_.track(frame, &simulator_.state(), &timer_);
    if (!vertices_ && !result.features.empty()) vertices_.emplace(result.features, volume(), first_);
    return result;
  }

  void addShape(Nanoseconds stamp, FrameOutput* output) {
    {
      const auto scope = timer_.stage(kSimulation);
      move(output->tracking.targets, stamp);
    }
    const auto scope = timer_.stage(kSurface);
    output->volume = simulator_.state();
    output->surface = surface_.apply(simulator_.state());
  }

  void move(const TargetSet& targets, Nanoseconds stamp) {
    if (targets.reset || options_.shape != Shape::kAlone) return simulator_.step(targets, stamp);
    Points vertices = simulator_.state().vertices;
    for (const Target& target : targets.targets) {
      Eigen::Index corner = 0;
      target.place.barycentric.maxCoeff(&corner);
      vertices.row(volume().tets(target.place.tet, corner)) = target.position;
    }
    simulator_.setVertices(vertices);
  }

  const Options options_;
  StageTimer timer_;
  BodyTracker tracker_;
  Simulator simulator_;
  VisualSurface surface_;
  std::vector<MaterialPoint> places_;  ///< of the volume's vertices
  Points first_;                       ///< the volume's vertices in the first frame
  std::optional<FrameFeatures> features_;
  std::optional<FollowedVertices> vertices_;
  AtomicBag bag_;
  ResultBag results_;
  int frames_ = 0;
};

void run(const Options& options) {
  PaperMethod method(options, buildObjectModel(loadObjectDescription(options.object, FileScope::kOwnFolder)));
  CameraIngest ingest{CameraIngestConfig()};
  readBagFrames(
      openBag(options.recording), BagFramesConfig(), &ingest,
      [&](const RgbdFrame& frame, const std_msgs::Header& header, double) { method.process(frame, header); });
  method.finish();
}

}  // namespace
}  // namespace softbody::evaluation

int main(int argc, char** argv) {
  using softbody::evaluation::Shape;
  softbody::evaluation::Options options;
  CLI::App app("Tracks a body as Kang et al. 2022 write: vertices follow ORB features (eq. 3-4)");
  app.add_option("recording", options.recording, "bag")->required()->check(CLI::ExistingFile);
  app.add_option("--object", options.object, "object YAML")->required()->check(CLI::ExistingPath);
  app.add_option("--output", options.output, "bag to write")->required();
  app.add_option("--shape", options.shape, "fem: eq. 8-9; pd: eq. 10-11; alone: no simulation (Figure 6)")
      ->transform(CLI::CheckedTransformer(std::map<std::string, Shape>{
          {"fem", Shape::kFem}, {"pd", Shape::kProjectiveDynamics}, {"alone", Shape::kAlone}}));
  app.add_option("--max-features", options.max_features, "N_p")->check(CLI::PositiveNumber);
  app.add_flag("--own-features", options.own_features, "those of our tracker, not ORB between frames");
  return softbody::runTool(&app, argc, argv, [&] {
    softbody::evaluation::run(options);
    return 0;
  });
}
