#include <fmt/format.h>
#include <softbody_msgs/CutHistory.h>
#include <softbody_msgs/PinRegion.h>
#include <softbody_msgs/Targets.h>

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
    targets_ = add<softbody_msgs::Targets>(&node_, topics::kTargets, 12, [this] {
      return blockTargets(*topology_.get(), choice_.oneIn(30), &choice_);
    });
    pins_ = add<softbody_msgs::PinRegion>(&node_, topics::kPin, 1, [this] { return pin(); });
    pins_->onSent([this](const softbody_msgs::PinRegion& pin) { pin_names_.insert(pin.name); });
    cuts_ = add<softbody_msgs::Cut>(&node_, topics::kCut, 1, [this] { return cut(); });
    if (!with_surface) return;
    surface_edits_ = add<softbody_msgs::CutHistory>(
        &node_, topics::kSurfaceCuts, 1, [this] { return editedFurther(*edits_.get(), &choice_); });
  }

  std::string check() override {
    releasePins();
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

  softbody_msgs::PinRegion pin() {
    softbody_msgs::PinRegion pin;
    pin.name = choice_.oneIn(2) ? "grip" : "clamp";
    pin.release = choice_.oneIn(2);
    pin.header.frame_id = choice_.oneIn(2) ? "" : "world";
    pin.max.x = 0.01f;
    pin.max.y = pin.max.z = 1.0f;
    return pin;
  }

  void releasePins() {
    for (const std::string& name : pin_names_) {
      softbody_msgs::PinRegion release;
      release.name = name;
      release.release = 1;
      pins_->send(boost::make_shared<softbody_msgs::PinRegion>(release));
    }
    pin_names_.clear();
  }

  void undoAll() {
    if (surface_edits_ != nullptr) {
      softbody_msgs::CutHistory uncut = *edits_.get();
      ++uncut.revision;
      uncut.cuts.clear();
      uncut.stroke_sizes.clear();
      uncut.strokes_in_force = 0;
      uncut.stroke_is_open = 0;
      return surface_edits_->send(boost::make_shared<softbody_msgs::CutHistory>(uncut));
    }
    softbody_msgs::Cut reset;
    reset.kind = softbody_msgs::Cut::RESET;
    reset.revision = topology_.get()->revision + 1;
    cuts_->send(boost::make_shared<softbody_msgs::Cut>(reset));
  }

  /// Good targets place the body and hold it.
  std::string follows() {
    ros::Time stamp;
    for (int i = 0; i < kGoodFrames; ++i) {
      LoneRos::instance().advance(0.033);
      stamp = LoneRos::instance().now();
      targets_->send(
          boost::make_shared<softbody_msgs::Targets>(blockTargets(*topology_.get(), i < 8, &choice_)));
    }
    if (!state_.hasStamp(stamp)) return "no state comes for good targets";
    return whyOdd(*state_.get(), *topology_.get());
  }

  Choice choice_{7};
  DrivenNode node_;
  Newest<softbody_msgs::TetTopology> topology_;
  Newest<softbody_msgs::CutHistory> edits_;
  Newest<softbody_msgs::MeshState> state_;
  std::set<std::string> pin_names_;  ///< that were sent since the last check
  TopicInput<softbody_msgs::Targets>* targets_;
  TopicInput<softbody_msgs::PinRegion>* pins_;
  TopicInput<softbody_msgs::Cut>* cuts_;
  TopicInput<softbody_msgs::CutHistory>* surface_edits_ = nullptr;
};

}  // namespace

std::unique_ptr<Target> makeSimulatorTarget() { return std::make_unique<SimulatorTarget>(true); }
std::unique_ptr<Target> makeLoneSimulatorTarget() { return std::make_unique<SimulatorTarget>(false); }

}  // namespace softbody::fuzz
