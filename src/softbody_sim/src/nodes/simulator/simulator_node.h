#pragma once

#include <ros/ros.h>
#include <softbody_msgs/SetMaterial.h>
#include <softbody_msgs/Targets.h>

#include <optional>
#include <set>
#include <string>

#include "nodes/forces/force_publisher.h"
#include "nodes/prediction/prediction_service.h"
#include "nodes/simulator/gripper_input.h"
#include "nodes/simulator/object_loader.h"
#include "nodes/simulator/simulator_diagnostics.h"
#include "nodes/simulator/surroundings_input.h"
#include "nodes/simulator/surroundings_tracker.h"
#include "nodes/simulator/volume_publisher.h"
#include "softbody_common/ros/cut_messages.h"
#include "softbody_common/ros/live_parameters.h"
#include "softbody_common/ros/newest_only.h"
#include "softbody_common/ros/stamp_gate.h"
#include "softbody_common/time/stage_timer.h"
#include "softbody_sim/cutting/binding/cuttable_body.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/ros/simulator_options.h"

namespace softbody {

/// Subscribes to targets, cuts and pins; takes pins and obstacles by service; follows a gripper; predicts;
/// publishes states of the volumetric model; loads another object. If the targets stop, for example because
/// the camera stalls, it continues at its own rate. Parameters: simulatorNodeParameters().
class SimulatorNode {
 public:
  /// @throw std::invalid_argument if a parameter or a file of the object cannot be used.
  SimulatorNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node);

 private:
  SimulatorNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                const SimulatorOptions& options);
  SimulatorNode(ros::NodeHandle node, const ros::NodeHandle& private_node, const SimulatorOptions& options,
                const SimulatedObject& object, const SurroundingsConfig& surroundings);

  void prepareSoon(ros::NodeHandle* node);
  void onTargets(const softbody_msgs::TargetsConstPtr& message);
  void onCut(const softbody_msgs::CutConstPtr& message);
  void onSurfaceEdits(const softbody_msgs::CutHistoryConstPtr& message);
  void onFreeRun();
  void applyOptions(const SimulatorOptions& next);
  bool onSetMaterial(softbody_msgs::SetMaterial::Request& request,
                     softbody_msgs::SetMaterial::Response& response);
  void useObject(NextObject* next);

  Present present(const std::set<std::string>& frames);
  bool step(const softbody_msgs::Targets& message, const std_msgs::Header& header);
  void requireBodyFrame(const TargetSet& targets, const std::string& frame_id) const;
  bool admits(const ros::Time& stamp);
  void restart();
  CuttableBody makeBody();
  bool applyCut(const softbody_msgs::Cut& message, std::string* reason);
  void adopt(const EditedBody& theirs);
  void keepOwnBody();
  void publishOwnEdits();
  void publishEdited(const ros::Time& stamp);
  void publishState(const std_msgs::Header& header);

  /// The last targets that were used.
  struct LastTargets {
    TargetSet set;
    std_msgs::Header header;
    ros::Time arrival;  ///< 0: none since the simulation started
  };

  SimulatorOptions options_;  ///< with the material that is in force
  StageTimer timer_;
  Simulator simulator_;
  CuttableBody body_;  ///< the tets; the simulator follows them
  SurroundingsTracker surroundings_;
  StampGate stamps_;  ///< of the targets
  LastTargets last_;
  Timeline clock_;  ///< of the steps without targets
  VolumePublisher publisher_;
  ForcePublisher forces_;
  SimulatorDiagnostics diagnostics_;
  // Last, so that callbacks end before the members that they use.
  SurroundingsInput surroundings_input_;
  std::optional<GripperInput> gripper_;
  NewestOnly<softbody_msgs::TargetsConstPtr> targets_;
  ros::Subscriber targets_subscriber_, cut_subscriber_, edits_subscriber_;
  ros::ServiceServer set_material_;
  ros::Timer free_run_timer_;
  ros::WallTimer prepare_timer_;
  PredictionService predictions_;
  LiveParameters live_parameters_;
  ObjectLoader loader_;
};

}  // namespace softbody
