#pragma once

#include <geometry_msgs/PolygonStamped.h>
#include <ros/ros.h>
#include <softbody_msgs/Cut.h>
#include <softbody_msgs/CutBody.h>
#include <softbody_msgs/PreviewCut.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/transform_listener.h>

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "softbody_sim/cutting/cuttable_surface.h"

namespace softbody {

/// Where the surface's cuts come from: the blade, services, and recorded cuts that are played. Each is
/// carried out here at once and published for the simulator, whose next topology and state then bring it
/// about. There is one cut at a time on that way.
class SurfaceEditor {
 public:
  /// @param on_cut called after each cut. @param on_preview called with what a cut would do.
  SurfaceEditor(const ros::NodeHandle& node, ros::NodeHandle private_node, std::string body_frame,
                const CuttingConfig& config, std::function<void()> on_cut,
                std::function<void(const CutPreview&)> on_preview);

  /// A body that is not cut, or whose cuts are not known. @throw std::invalid_argument as CuttableSurface.
  void start(const MeshTopology& visual, const TetTopology& volume);
  bool started() const { return body_.has_value(); }
  const CuttableSurface& body() const { return *body_; }
  /// Whether a state of the volume has come.
  bool placed() const { return state_.has_value(); }

  /// Every state of the volume.
  void onState(const MeshState& state, const std_msgs::Header& header);

  /// The simulator has sent its topology, which it does every second: the last cut goes out once more if it
  /// does not have it. What it still does not have then is taken back.
  void resendTo(std::uint32_t volume_revision);

 private:
  void onBlade(const geometry_msgs::PolygonStampedConstPtr& message);
  void onCut(const softbody_msgs::CutConstPtr& message);
  bool onCutService(softbody_msgs::CutBody::Request& request, softbody_msgs::CutBody::Response& response);
  bool onPreview(softbody_msgs::PreviewCut::Request& request, softbody_msgs::PreviewCut::Response& response);
  bool onEdit(CutKind kind, std_srvs::Trigger::Response& response);

  void follow(const geometry_msgs::PolygonStamped& blade);
  void leaveOut(const geometry_msgs::PolygonStamped& blade);
  void tear();
  std::optional<Points> inStatesFrame(const geometry_msgs::PolygonStamped& blade);
  bool apply(const Cut& cut, std::string* reason);
  void publish(const Cut& cut, const ros::Time& stamp);
  bool isStuckAt(std::uint32_t volume_revision);
  void rollBack(std::uint32_t volume_revision);
  template <typename Request>
  TriangleMesh patchOf(const Request& request) const;
  MeshState stateOrRest() const;
  bool isIdle(std::string* reason) const;

  ros::NodeHandle node_;
  std::string body_frame_;
  CuttingConfig config_;
  std::function<void()> on_cut_;
  std::function<void(const CutPreview&)> on_preview_;
  std::optional<CuttableSurface> body_;
  Points rest_;                     ///< vertices of the uncut visual mesh
  std::optional<MeshState> state_;  ///< the last one
  std_msgs::Header state_header_;
  std::deque<geometry_msgs::PolygonStampedConstPtr> waiting_blades_;  ///< their states have not come yet
  int left_out_ = 0;                ///< blades in a row that came with no state of their time
  softbody_msgs::CutPtr last_cut_;  ///< null: there is none, or the simulator has it
  /// Since when, and at which revision, the simulator sends topologies from before a cut.
  std::optional<std::pair<ros::WallTime, std::uint32_t>> behind_;
  tf2_ros::Buffer buffer_;
  std::unique_ptr<tf2_ros::TransformListener>
      listener_;  ///< once the blade is in another frame than the body

  ros::Publisher cut_publisher_;
  ros::Subscriber blade_subscriber_, cut_subscriber_;
  ros::ServiceServer cut_service_, preview_service_, undo_service_, redo_service_, reset_service_;
};

}  // namespace softbody
