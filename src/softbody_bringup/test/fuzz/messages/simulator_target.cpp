#include <fmt/format.h>
#include <softbody_msgs/CutHistory.h>
#include <softbody_msgs/Pin.h>
#include <softbody_msgs/PinRegion.h>
#include <softbody_msgs/Predict.h>
#include <softbody_msgs/PredictPlansActionGoal.h>
#include <softbody_msgs/Release.h>
#include <softbody_msgs/SetMaterial.h>
#include <softbody_msgs/SetObstacle.h>
#include <softbody_msgs/Targets.h>
#include <std_msgs/Bool.h>
#include <std_srvs/SetBool.h>
#include <tf2_msgs/TFMessage.h>

#include <set>

#include "fuzz/messages/block.h"
#include "fuzz/messages/target.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_sim/ros/nodes.h"

namespace softbody::fuzz {
namespace {

class SimulatorTarget : public Target {
 public:
  /// @param with_surface a node that publishes edits stands beside it; without one, cuts come alone.
  explicit SimulatorTarget(bool with_surface)
      : node_("simulator", simulatorParameters(), makeSimulatorNode),
        topology_(&node_, topics::kVolumeTopology),
        edits_(&node_, topics::kVolumeCuts),
        state_(&node_, topics::kVolumeState) {
    node_.process();
    targets_ = add<softbody_msgs::Targets>(&node_, topics::kTargets, 60, [this] {
      return blockTargets(*topology_.get(), choice_.oneIn(30), &choice_);
    });
    add<softbody_msgs::PinRegion>(&node_, topics::kPin, 1, [this] {
      softbody_msgs::PinRegion region = pin<softbody_msgs::PinRegion>();
      region.release = choice_.oneIn(2);
      return region;
    })->onSent([this](const auto& pin) { names_.insert(pin.name); });
    cuts_ = add<softbody_msgs::Cut>(&node_, topics::kCut, 1, [this] { return cut(); });
    addGripper();
    addServices();
    addPredictions();
    if (!with_surface) return;
    surface_edits_ = add<softbody_msgs::CutHistory>(
        &node_, topics::kSurfaceCuts, 1, [this] { return editedFurther(*edits_.get(), &choice_); });
  }

  std::string check() override {
    parameters_->sendGood();
    material_->sendGood();
    letGo();
    undoAll();
    if (topology_.get()->tets.size() != static_cast<std::size_t>(block().model.volume.tets.rows()))
      return fmt::format("the body has {} tets after a reset", topology_.get()->tets.size());
    return follows();
  }

 private:
  static constexpr int kGoodFrames = 30;

  /// A body of many pieces makes every message slow.
  softbody_msgs::Cut cut() {
    constexpr std::size_t kMostTets = 600;
    const std::uint32_t revision = topology_.get()->revision + 1;
    softbody_msgs::Cut cut = planeCut(revision, revision, &choice_);
    if (topology_.get()->tets.size() < kMostTets && !choice_.oneIn(4)) return cut;
    cut.kind = softbody_msgs::Cut::RESET;
    cut.patch_vertices.clear();
    cut.patch_triangles.clear();
    return cut;
  }

  void addGripper() {
    add<tf2_msgs::TFMessage>(&node_, "/tf_static", 1, [] { return hand(); })->sendGood();
    closed_ = add<std_msgs::Bool>(&node_, topics::kGripperClosed, 1, [this] { return isClosed(); });
    addService<std_srvs::SetBool>(&node_, "grip", [this] {
      std_srvs::SetBool::Request request;
      request.data = choice_.oneIn(2);
      return request;
    });
  }

  void addServices() {
    parameters_ = addParameters(&node_);
    addService<softbody_msgs::Pin>(&node_, "pin", [this] {
      return pin<softbody_msgs::Pin::Request>();
    })->onSent([this](const auto& pin) { names_.insert(pin.name); });
    addService<softbody_msgs::SetObstacle>(&node_, "set_obstacle", [] {
      return ball();
    })->onSent([this](const auto& obstacle) { names_.insert(obstacle.name); });
    release_ = addService<softbody_msgs::Release>(&node_, "release", [] {
      softbody_msgs::Release::Request request;
      request.name = "ball";
      return request;
    });
    material_ = addService<softbody_msgs::SetMaterial>(&node_, "set_material", [] {
      softbody_msgs::SetMaterial::Request request;
      request.youngs_modulus_pa = 2.0e4;
      request.poisson_ratio = 0.2;
      request.density_kg_m3 = 30.0;
      request.damping = 0.1;
      return request;
    });
    addService<softbody_msgs::LoadObject>(&node_, "load_object", [] { return blockFile(); });
  }

  void addPredictions() {
    addService<softbody_msgs::Predict>(&node_, "predict",
                                       [] { return plan<softbody_msgs::Predict::Request>(); });
    add<softbody_msgs::PredictPlansActionGoal>(&node_, "simulator/predict_plans/goal", 1, [] {
      softbody_msgs::PredictPlansActionGoal goal;
      goal.goal = plan<softbody_msgs::PredictPlansGoal>();
      return goal;
    });
    add<actionlib_msgs::GoalID>(&node_, "simulator/predict_plans/cancel", 1,
                                [] { return actionlib_msgs::GoalID(); });
  }

  static tf2_msgs::TFMessage hand() {
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    message.transforms[0].header.frame_id = "camera_color_optical_frame";
    message.transforms[0].child_frame_id = "hand";
    message.transforms[0].transform.translation.z = 0.5;
    message.transforms[0].transform.rotation.w = 1.0;
    return message;
  }

  std_msgs::Bool isClosed() {
    std_msgs::Bool message;
    message.data = choice_.oneIn(2);
    return message;
  }

  /// Far from the body.
  static softbody_msgs::SetObstacle::Request ball() {
    softbody_msgs::SetObstacle::Request request;
    request.name = "ball";
    request.shape = "sphere";
    request.radius = 0.01;
    request.pose.position.z = 2.0;
    request.pose.orientation.w = 1.0;
    return request;
  }

  /// A pin that moves, and an obstacle. So short that no mutation of its time takes long.
  template <typename Request>
  static Request plan() {
    Request request;
    request.times = {0.01};
    request.plans.resize(1);
    softbody_msgs::MotionPlan& plan = request.plans[0];
    plan.pins.resize(1);
    plan.pins[0].name = "planned";
    plan.pins[0].max.x = 0.01f;
    plan.pins[0].max.y = plan.pins[0].max.z = 1.0f;
    plan.motions.resize(1);
    plan.motions[0].name = "planned";
    plan.motions[0].times = request.times;
    plan.motions[0].poses.resize(1);
    plan.motions[0].poses[0].orientation.w = 1.0;
    plan.obstacles.resize(1);
    plan.obstacles[0].name = "wall";
    plan.obstacles[0].shape = "plane";
    plan.obstacles[0].pose = plan.motions[0].poses[0];
    return request;
  }

  template <typename Region>
  Region pin() {
    Region pin;
    pin.name = choice_.oneIn(2) ? "grip" : "clamp";
    pin.header.frame_id = choice_.oneIn(2) ? "" : "world";
    pin.max.x = 0.01f;
    pin.max.y = pin.max.z = 1.0f;
    return pin;
  }

  /// Pins and obstacles, and what the gripper holds.
  void letGo() {
    closed_->send(std_msgs::Bool());
    names_.insert("gripper");
    for (const std::string& name : names_) {
      softbody_msgs::Release::Request release;
      release.name = name;
      release_->send(release);
    }
    names_.clear();
  }

  void undoAll() {
    if (surface_edits_ != nullptr) {
      softbody_msgs::CutHistory uncut = *edits_.get();
      ++uncut.revision;
      uncut.cuts.clear();
      uncut.stroke_sizes.clear();
      uncut.strokes_in_force = 0;
      uncut.stroke_is_open = 0;
      return surface_edits_->send(uncut);
    }
    softbody_msgs::Cut reset;
    reset.kind = softbody_msgs::Cut::RESET;
    reset.revision = topology_.get()->revision + 1;
    cuts_->send(reset);
  }

  /// Good targets place the body and hold it.
  std::string follows() {
    ros::Time stamp;
    for (int i = 0; i < kGoodFrames; ++i) {
      LoneRos::instance().advance(0.033);
      stamp = LoneRos::instance().now();
      targets_->send(blockTargets(*topology_.get(), i < 8, &choice_));
    }
    if (!state_.hasStamp(stamp)) return "no state comes for good targets";
    return whyOdd(*state_.get(), *topology_.get());
  }

  Choice choice_{7};
  DrivenNode node_;
  Newest<softbody_msgs::TetTopology> topology_;
  Newest<softbody_msgs::CutHistory> edits_;
  Newest<softbody_msgs::MeshState> state_;
  std::set<std::string> names_;  ///< of pins and obstacles that were sent since the last check
  TopicInput<softbody_msgs::Targets>* targets_;
  TopicInput<std_msgs::Bool>* closed_;
  ParameterInput* parameters_;
  ServiceInput<softbody_msgs::SetMaterial>* material_;
  ServiceInput<softbody_msgs::Release>* release_;
  TopicInput<softbody_msgs::Cut>* cuts_;
  TopicInput<softbody_msgs::CutHistory>* surface_edits_ = nullptr;
};

}  // namespace

std::unique_ptr<Target> makeSimulatorTarget() { return std::make_unique<SimulatorTarget>(true); }
std::unique_ptr<Target> makeLoneSimulatorTarget() { return std::make_unique<SimulatorTarget>(false); }

}  // namespace softbody::fuzz
