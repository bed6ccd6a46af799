#pragma once

#include <ros/ros.h>
#include <softbody_msgs/Cut.h>

#include <functional>
#include <optional>
#include <string>

#include "nodes/surface/blade_input.h"
#include "nodes/surface/cut_publisher.h"
#include "softbody_sim/cutting/binding/cuttable_surface.h"

namespace softbody {

/// Cuts the surface: by the blade, by tearing, by services and by recorded cuts. A cut is made here at once
/// and published for the simulator, whose next topology and state confirm it. One cut at a time is pending.
class SurfaceEditor {
 public:
  /// @param on_cut called after each cut.
  SurfaceEditor(ros::NodeHandle node, const std::string& body_frame, const CuttingConfig& config,
                std::function<void()> on_cut);

  /// Starts with an uncut body, or one whose cuts are not known.
  /// @throw std::invalid_argument as CuttableSurface; the body before stays.
  void start(const MeshTopology& visual, const TetTopology& volume);
  bool started() const { return body_.has_value(); }
  const CuttableSurface& body() const { return *body_; }
  /// Vertices of the visual mesh at the start [m].
  const Points& startVertices() const { return start_vertices_; }
  /// Whether a state of the volume has come.
  bool placed() const { return state_.has_value(); }

  void onState(const MeshState& state, const std_msgs::Header& header);
  /// The simulator has sent its topology. A pending cut that it has not made is sent again, and finally taken
  /// back.
  void onVolumeTopology(std::uint32_t revision);

  /// Whether an edit is possible now. @param reason why not.
  bool isReady(std::string* reason) const;
  /// Makes a cut and publishes it. @return false if it is refused. @param reason why.
  bool apply(const Cut& cut, std::string* reason);

 private:
  void onBlade(const Points& polygon, const ros::Time& stamp);
  void onRecordedCut(const softbody_msgs::CutConstPtr& message);
  void tear();
  void publish(const Cut& cut, const ros::Time& stamp);
  void rollBack(std::uint32_t volume_revision);
  MeshState stateOrRest() const;

  CuttingConfig config_;
  std::function<void()> on_cut_;
  std::optional<CuttableSurface> body_;
  Points start_vertices_;
  std::optional<MeshState> state_;  ///< the last one
  ros::Time state_stamp_;
  CutPublisher cuts_;
  // Last, so that callbacks end before the members that they use.
  BladeInput blade_;
  ros::Subscriber cut_subscriber_;
};

}  // namespace softbody
