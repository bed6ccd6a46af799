#pragma once

#include <ros/ros.h>
#include <softbody_msgs/Cut.h>

#include <deque>
#include <functional>
#include <optional>
#include <string>

#include "nodes/object_visual.h"
#include "nodes/surface/blade_input.h"
#include "nodes/surface/targets_input.h"
#include "softbody_common/ros/cut_messages.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"

namespace softbody {

/// Cuts the surface: by the blade, by tearing, by services and by recorded cuts. A cut is made here at once
/// and published with all edits of the body. It is pending until a topology or state of the simulator shows
/// that the simulator has followed. Where the simulator's edits differ, the surface follows the simulator.
class SurfaceEditor {
 public:
  /// @param visual the uncut visual mesh; outlives this. @param on_edit called after each edit.
  SurfaceEditor(ros::NodeHandle node, const std::string& body_frame, ObjectVisual* visual,
                const CuttingConfig& config, std::function<void()> on_edit);

  /// Starts with a body whose cuts are not known; its visual mesh is assumed to be uncut.
  /// @throw std::invalid_argument as CuttableBody; the body before stays.
  void start(const TetTopology& volume);
  bool started() const { return body_.has_value(); }
  const CuttableBody& body() const { return *body_; }
  /// Vertices of the visual mesh at the start [m].
  const Points& startVertices() const { return visual_->mesh().rest_vertices; }
  /// Whether a state of the volume has come.
  bool placed() const { return state_.has_value(); }

  void onState(const MeshState& state, const std_msgs::Header& header);
  /// The simulator has sent its topology. An edit that it does not make is taken back after a while.
  /// @return false if it cannot be taken back: the simulator has another body, with which the surface must
  /// start.
  bool onVolumeTopology(std::uint32_t revision);
  /// The simulator has sent its edits. @throw std::invalid_argument as CuttableBody; nothing has changed.
  void onVolumeEdits(const EditedBody& theirs);

  /// Whether an edit is possible now. @param reason why not.
  bool isReady(std::string* reason) const;
  /// Makes a cut and publishes it. @return false if it is refused. @param reason why.
  bool apply(const Cut& cut, std::string* reason);

 private:
  void noteSimulator(std::uint32_t revision);
  void onBlade(const Points& polygon, const ros::Time& stamp);
  void onRecordedCut(const softbody_msgs::CutConstPtr& message);
  void makeRecordedCuts();
  void makeRecordedCut(const softbody_msgs::Cut& message);
  void tear();
  void publish(const Cut& cut, const ros::Time& stamp);
  void finishEdit(const ros::Time& stamp);
  void publishEdits(const ros::Time& stamp, bool pending);
  bool takeBack(std::uint32_t simulator_revision);
  void adopt(const EditedBody& theirs);
  void resetInputs();
  MeshState stateOrRest() const;

  CuttableBody uncutBody(const TetTopology& volume) const;

  const std::string body_frame_;
  ObjectVisual* visual_;
  const CuttingConfig config_;
  std::function<void()> on_edit_;
  std::optional<CuttableBody> body_;
  std::optional<MeshState> state_;  ///< the last one
  std_msgs::Header state_header_;
  bool pending_ = false;                       ///< the simulator has not made the last edit yet
  std::optional<ros::WallTime> behind_since_;  ///< the simulator publishes without the last edit
  ros::Publisher cut_publisher_, edits_publisher_;
  std::deque<softbody_msgs::CutConstPtr> recorded_cuts_;  ///< they wait for a pending edit
  // Last, so that callbacks end before the members that they use.
  BladeInput blade_;
  std::optional<TargetsInput> targets_;  ///< only if the body can tear
  ros::Subscriber cut_subscriber_;
};

}  // namespace softbody
