#include <fmt/format.h>
#include <geometry_msgs/PolygonStamped.h>
#include <softbody_msgs/ClosestPoint.h>
#include <softbody_msgs/CutBody.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/PreviewCut.h>
#include <softbody_msgs/SaveMesh.h>
#include <std_srvs/Trigger.h>

#include "fuzz/messages/block.h"
#include "fuzz/messages/target.h"
#include "fuzz/scratch_files.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_sim/ros/nodes.h"

namespace softbody::fuzz {
namespace {

/// A surface beside a simulator that does its work. Mutated messages come as if from the simulator, the tool
/// tracker or a user.
class SurfaceTarget : public Target {
 public:
  SurfaceTarget()
      : surface_("surface", simulatorParameters(), makeSurfaceNode),
        simulator_("simulator", simulatorParameters(), makeSimulatorNode),
        volume_(&simulator_, topics::kVolumeTopology),
        volume_edits_(&simulator_, topics::kVolumeCuts),
        volume_state_(&simulator_, topics::kVolumeState),
        topology_(&surface_, topics::kSurfaceTopology),
        state_(&surface_, topics::kSurfaceState),
        targets_(&simulator_, topics::kTargets, {}) {
    process();
    add<softbody_msgs::TetTopology>(&surface_, topics::kVolumeTopology, 3, [this] { return *volume_.get(); });
    add<softbody_msgs::CutHistory>(&surface_, topics::kVolumeCuts, 3, [this] {
      return choice_.oneIn(4) ? editedFurther(*volume_edits_.get(), &choice_) : *volume_edits_.get();
    });
    add<softbody_msgs::MeshState>(&surface_, topics::kVolumeState, 20, [this] { return volumeState(); });
    add<softbody_msgs::Targets>(&surface_, topics::kTargets, 3,
                                [this] { return blockTargets(*volume_.get(), false, &choice_); });
    add<geometry_msgs::PolygonStamped>(&surface_, topics::kToolBlade, 10, [this] { return blade(); });
    add<softbody_msgs::Cut>(&surface_, topics::kCut, 1, [this] {
      const std::uint32_t revision = volume_.get()->revision + 1;
      return planeCut(revision, revision, &choice_);
    });
    addServices();
  }

  std::string check() override {
    parameters_->sendGood();
    std::string fault = frames();
    if (!fault.empty()) return "before a cut: " + fault;
    softbody_msgs::CutBody::Response response;
    bool is_published = false;
    const ros::WallTime deadline = ros::WallTime::now() + ros::WallDuration(kPatience_s);
    while (!is_published && ros::WallTime::now() < deadline) {
      reset_->sendGood();
      fault = frames();
      if (!fault.empty()) return "before a cut: " + fault;
      response = cut_->sendGood();
      fault = frames();
      if (!fault.empty()) return "after a cut: " + fault;
      is_published = response.success && topology_.get()->revision >= response.revision;
    }
    if (!is_published) return "no cut is possible, or none is published: " + response.message;
    reset_->sendGood();
    fault = frames();
    return fault.empty() ? "" : "after a reset: " + fault;
  }

 private:
  // A cut that the simulator does not make is taken back after 3 s.
  static constexpr double kPatience_s = 10.0;
  static constexpr int kMostFrames = 100;  // some seconds, in which the simulator sends its topology again

  void process() {
    for (int i = 0; i < 3; ++i) {  // an answer of one is a question to the other
      simulator_.process();
      surface_.process();
    }
  }

  softbody_msgs::MeshState volumeState() {
    softbody_msgs::MeshState state;
    if (volume_state_.get() != nullptr) state = *volume_state_.get();
    if (state.vertices.size() != volume_.get()->rest_vertices.size()) {
      state.vertices = volume_.get()->rest_vertices;
      state.confidence.assign(state.vertices.size(), 0.5f);
    }
    state.revision = volume_.get()->revision;
    state.header.frame_id = "camera_color_optical_frame";
    state.header.stamp = state.observed = LoneRos::instance().now();
    return state;
  }

  /// A blade in or near the block.
  geometry_msgs::PolygonStamped blade() {
    geometry_msgs::PolygonStamped blade;
    blade.header.stamp = LoneRos::instance().now();
    blade.header.frame_id = "camera_color_optical_frame";
    depth_m_ = choice_.oneIn(20) ? 0.1 : depth_m_ - 0.004;
    for (const auto& [x, y] :
         {std::pair(0.05, 0.0), std::pair(0.05, 0.1), std::pair(0.052, 0.1), std::pair(0.052, 0.0)})
      blade.polygon.points.push_back(toPoint32(blockPose() * Eigen::Vector3d(x, depth_m_ + y, 0.01)));
    return blade;
  }

  template <typename Service>
  static typename Service::Request middle() {
    typename Service::Request request;
    request.point.x = 0.052;
    request.normal.x = 1.0;
    request.normal.y = 0.1;
    return request;
  }

  void addServices() {
    parameters_ = addParameters(&surface_);
    cut_ =
        addService<softbody_msgs::CutBody>(&surface_, "cut", [] { return middle<softbody_msgs::CutBody>(); });
    addService<softbody_msgs::PreviewCut>(&surface_, "preview",
                                          [] { return middle<softbody_msgs::PreviewCut>(); });
    for (const char* name : {"undo", "redo", "reset"})  // the last one stays known
      reset_ = addService<std_srvs::Trigger>(&surface_, name, [] { return std_srvs::Trigger::Request(); });
    addService<softbody_msgs::LoadObject>(&surface_, "prepare_object", [] { return blockFile(); });
    addService<softbody_msgs::ClosestPoint>(&surface_, "closest_point", [] {
      softbody_msgs::ClosestPoint::Request request;
      request.point.point.z = 0.5;
      return request;
    });
    addService<softbody_msgs::SaveMesh>(&surface_, "save_mesh", [] {
      softbody_msgs::SaveMesh::Request request;
      request.name = "saved.obj";
      std::filesystem::remove(scratch() / request.name);
      return request;
    });
  }

  /// Good frames until simulator and surface agree. @return what does not fit.
  std::string frames() {
    std::string fault;
    for (int i = 0; i < kMostFrames; ++i) {
      LoneRos::instance().advance(0.033);
      process();
      const ros::Time stamp = LoneRos::instance().now();
      targets_.send(blockTargets(*volume_.get(), i < 8, &choice_));
      process();
      fault = state_.hasStamp(stamp) ? whyApart() : "no state of the surface";
      constexpr int kFewestFrames = 12;
      if (fault.empty() && i >= kFewestFrames) return "";
    }
    return fault;
  }

  std::string whyApart() {
    const softbody_msgs::MeshState& state = *state_.get();
    const softbody_msgs::MeshTopology& topology = *topology_.get();
    if (state.revision != topology.revision || state.vertices.size() != topology.rest_vertices.size())
      return "state and topology of the surface differ";
    if (topology.revision != volume_.get()->revision)
      return fmt::format("the surface is at revision {}, the volume at {}", topology.revision,
                         volume_.get()->revision);
    for (std::size_t v = 0; v < state.vertices.size(); ++v) {
      const double distance =
          (fromPoint32(state.vertices[v]) - blockPose() * fromPoint32(topology.rest_vertices[v])).norm();
      if (!(distance < 0.03))
        return fmt::format("vertex {} of {} of the surface is {} m from its place; revision {}", v,
                           state.vertices.size(), distance, state.revision);
    }
    return whyOdd(*volume_state_.get(), *volume_.get());
  }

  Choice choice_{11};
  double depth_m_ = 0.1;            ///< of the blade
  DrivenNode surface_, simulator_;  ///< topics of both are the surface's, which comes first
  Newest<softbody_msgs::TetTopology> volume_;
  Newest<softbody_msgs::CutHistory> volume_edits_;
  Newest<softbody_msgs::MeshState> volume_state_;
  Newest<softbody_msgs::MeshTopology> topology_;
  Newest<softbody_msgs::MeshState> state_;
  TopicInput<softbody_msgs::Targets> targets_;
  ParameterInput* parameters_;
  ServiceInput<softbody_msgs::CutBody>* cut_;
  ServiceInput<std_srvs::Trigger>* reset_;
};

}  // namespace

std::unique_ptr<Target> makeSurfaceTarget() { return std::make_unique<SurfaceTarget>(); }

}  // namespace softbody::fuzz
