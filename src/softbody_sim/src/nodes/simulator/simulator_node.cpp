#include "nodes/simulator/simulator_node.h"

#include <fmt/format.h>
#include <malloc.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "softbody_common/geometry/tet_topology_check.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_sim/ros/conversions.h"

namespace softbody {
namespace {

constexpr char kStage[] = "Soft-body Simulation";
constexpr double kUndoMemory_mb = 40.0;  // the tets of hundreds of strokes
constexpr int kTargetsQueue = 10;        // target sets, until the newest of them is taken

/// @param options gets the material that is in force.
Simulator makeSimulator(const ObjectModel& model, SimulatorOptions* options, StageTimer* timer) {
  const auto scope = timer->stage(kStage, true);
  const Material material = withParameters(model.material, options->material);
  options->material = parametersOf(material);
  return {model.volume, material, options->simulator};
}

/// Whether a value differs that may change live.
template <typename Config>
bool isOther(const ParameterTable<Config>& table, const Config& a, const Config& b) {
  return table.liveValues(a) != table.liveValues(b);
}

}  // namespace

SimulatorNode::SimulatorNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : SimulatorNode(node, private_node, readSimulatorOptions(private_node)) {}

SimulatorNode::SimulatorNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                             const SimulatorOptions& options)
    : SimulatorNode(node, private_node, options,
                    loadSimulatedObject(options.object, fileScope(options.allow_outside)),
                    options.surroundings) {}

SimulatorNode::SimulatorNode(ros::NodeHandle node, const ros::NodeHandle& private_node,
                             const SimulatorOptions& options, const SimulatedObject& object,
                             const SurroundingsConfig& surroundings)
    : options_(options),
      simulator_(makeSimulator(object.model, &options_, &timer_)),
      body_(makeBody()),
      surroundings_(node, surroundings, {object.model.visual, object.model.volume}),
      stamps_(node.resolveName(topics::kTargets), StampGate::Repeats::kAccepted),
      publisher_(node, options_.body_frame),
      forces_(node, options_.wrench_frame),
      diagnostics_(node, private_node, &simulator_, &surroundings_),
      surroundings_input_(node, private_node, &simulator_, &surroundings_),
      targets_(node.getCallbackQueue(), [this](const auto& message) { onTargets(message); }),
      predictions_(node, private_node, [this](const auto& frames) { return present(frames); }),
      live_parameters_(private_node, simulatorNodeParameters(), &options_,
                       [this](const SimulatorOptions& next) { applyOptions(next); }),
      loader_(node, private_node, fileScope(options.allow_outside),
              {[this] { return simulator_.topology().revision; }, [this] { return simulator_.config(); },
               [this](NextObject* next) { useObject(next); }}) {
  if (surroundings.gripper) gripper_.emplace(node, private_node, surroundings, &simulator_, &surroundings_);
  for (const PinRegion& pin : object.pins) surroundings_.addPin(pin, object.model.volume);
  publisher_.publishEdited(body_, {});
  const ros::TransportHints hints = ros::TransportHints().tcpNoDelay();
  targets_subscriber_ = node.subscribe<softbody_msgs::Targets>(
      topics::kTargets, kTargetsQueue, [this](const auto& message) { targets_.add(message); }, {}, hints);
  cut_subscriber_ = node.subscribe(topics::kCut, 20, &SimulatorNode::onCut, this, hints);
  edits_subscriber_ = node.subscribe(topics::kSurfaceCuts, 1, &SimulatorNode::onSurfaceEdits, this, hints);
  set_material_ =
      ros::NodeHandle(private_node).advertiseService("set_material", &SimulatorNode::onSetMaterial, this);
  if (options_.free_run_rate_hz > 0.0) {
    free_run_timer_ = node.createTimer(toDuration(nanoseconds(1.0 / options_.free_run_rate_hz)),
                                       [this](const ros::TimerEvent&) { onFreeRun(); });
  }
  prepareSoon(&node);
}

/// In a callback: a nodelet manager loads the tracker meanwhile, which finds the body.
void SimulatorNode::prepareSoon(ros::NodeHandle* node) {
  prepare_timer_ = node->createWallTimer(
      ros::WallDuration(1e-3), [this](const ros::WallTimerEvent&) { simulator_.prepare(); }, true);
}

void SimulatorNode::onTargets(const softbody_msgs::TargetsConstPtr& message) {
  std_msgs::Header header = message->header;
  header.frame_id = frameName(header.frame_id, targets_subscriber_.getTopic());
  try {
    if (!step(*message, header)) return diagnostics_.countRefusedMessage();
  } catch (const std::exception& error) {
    diagnostics_.countRefusedMessage();
    ROS_WARN_STREAM_THROTTLE(1.0, "targets of " << message->header.stamp << " are not used: " << error.what()
                                                << "; rostopic info " << targets_subscriber_.getTopic()
                                                << " names the sender");
    return;
  }
  publishState(header);
  surroundings_.findConflicts(last_.set.targets, simulator_.topology().tets, simulator_.state().vertices);
  diagnostics_.setDropped(targets_.dropped());
}

Present SimulatorNode::present(const std::set<std::string>& frames) {
  if (!simulator_.placed()) throw std::invalid_argument("nothing to predict: the body is not placed yet");
  std_msgs::Header header = last_.header;
  header.stamp = toTime(simulator_.stamp());
  return {simulator_.copyOfPresent(),
          surroundings_.lastSurroundings(),
          surroundings_.pinAccuracy_m(),
          surroundings_.surfaceIn(simulator_.topology()),
          header,
          surroundings_.posesOf(frames)};
}

/// @return whether the stamp is accepted; if not, nothing changes. @throw std::invalid_argument likewise.
bool SimulatorNode::step(const softbody_msgs::Targets& message, const std_msgs::Header& header) {
  TargetSet targets = fromMessage(message);
  requireBodyFrame(targets, header.frame_id);
  simulator_.requireUsable(targets);
  if (!admits(header.stamp)) return false;
  if (!targets.reset && simulator_.hasLeft(targets)) {
    ROS_WARN("the body is far from all targets: it is placed again at body_pose");
    targets.reset = true;
  }
  const auto scope = timer_.stage(kStage);
  if (targets.reset) surroundings_.forgetPinPositions();
  const Surroundings& surroundings =
      targets.reset
          ? surroundings_.surroundingsAt(header.frame_id, header.stamp, verticesToHold(targets, simulator_),
                                         header.stamp)
          : surroundings_.surroundingsAt(header.frame_id, header.stamp, simulator_.state().vertices);
  simulator_.step(targets, toNanoseconds(header.stamp), surroundings);
  if (!publisher_.topologyHasStamp()) publisher_.publishTopology(simulator_.topology(), header.stamp);
  last_ = {simulator_.toCurrentRevision(std::move(targets)), header, ros::Time::now()};
  diagnostics_.countStep();
  return true;
}

/// The state is in the targets' frame; only targets with reset may change it.
void SimulatorNode::requireBodyFrame(const TargetSet& targets, const std::string& frame_id) const {
  if (targets.reset || !simulator_.placed() || frame_id == last_.header.frame_id) return;
  throw std::invalid_argument(fmt::format(
      "their frame_id is '{}', but the body is in '{}': only targets with reset may change the frame",
      frame_id, last_.header.frame_id));
}

/// Several target sets may belong to one stamp.
bool SimulatorNode::admits(const ros::Time& stamp) {
  const StampVerdict verdict = stamps_.judge(stamp);
  if (verdict.kind == StampVerdict::kJumpedBack) restart();
  return stamps_.admits(verdict);
}

CuttableBody SimulatorNode::makeBody() {
  CuttingConfig config;
  config.undo_memory_mb = kUndoMemory_mb;
  return CuttableBody(simulator_.topology(), config,
                      [this](const TetEdits& edits) { simulator_.apply(edits); });
}

void SimulatorNode::restart() {
  if (simulator_.topology().revision > 0)
    ROS_INFO("time jumped back: the simulation starts again with the uncut body");
  simulator_.reset();
  body_ = makeBody();
  surroundings_.updatePins(simulator_.topology(), {});
  last_ = {};
  keepOwnBody();
}

/// Without images nobody knows whether the hands that deform the body are gone. So the last targets stay.
void SimulatorNode::onFreeRun() {
  constexpr double kStall_s = 1.0;  // a camera that is late, or starts again, is back within a second
  const Nanoseconds now = toNanoseconds(ros::Time::now()), silence = now - toNanoseconds(last_.arrival);
  if (!clock_.judge(now).accepted() || last_.arrival.isZero() || seconds(silence) < kStall_s) return;
  std_msgs::Header header = last_.header;
  header.stamp = toTime(toNanoseconds(header.stamp) + silence);  // keeps the latency of the last image
  try {
    const auto scope = timer_.stage(kStage);
    simulator_.stepUnobserved(
        last_.set, toNanoseconds(header.stamp),
        surroundings_.surroundingsAt(header.frame_id, header.stamp, simulator_.state().vertices));
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(1.0, "the simulation cannot continue without images: " << error.what());
    return;
  }
  publishState(header);
}

/// The surface decides on cuts, because only it knows whether the visual mesh can be cut. Its edits come with
/// its history. Without it, the tets decide.
void SimulatorNode::onCut(const softbody_msgs::CutConstPtr& message) {
  if (edits_subscriber_.getNumPublishers() > 0) return;
  if (message->revision <= simulator_.topology().revision) return;  // sent again
  std::string reason;
  try {
    if (applyCut(*message, &reason)) return;
  } catch (const std::exception& error) {
    reason = error.what();
  }
  ROS_WARN_STREAM("the cut of revision " << message->revision << " is not made: " << reason);
}

bool SimulatorNode::applyCut(const softbody_msgs::Cut& message, std::string* reason) {
  const auto scope = timer_.stage("Cutting");
  if (!body_.apply(fromMessage(message), simulator_.state(), reason)) return false;
  if (body_.edits().body == 0) body_.setBody(ros::WallTime::now().toNSec());
  publishEdited(message.header.stamp);
  return true;
}

/// Follows the surface. Where the two nodes disagree, the surface follows the simulator. But a simulator that
/// has just started has nothing to say.
void SimulatorNode::onSurfaceEdits(const softbody_msgs::CutHistoryConstPtr& message) {
  const EditHistory& own = body_.edits();
  const bool is_new = own.body == 0;
  if (is_new && message->body == 0) return;
  // Own edits come again every second, but until then the surface would accept cuts that are never made.
  if (!is_new && message->body != own.body) return publishOwnEdits();
  if (!is_new && message->revision <= own.revision) return;
  try {
    const auto scope = timer_.stage("Cutting");
    adopt(fromMessage(*message));
    return publishEdited(message->header.stamp);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM("the cuts of the surface up to revision " << message->revision
                                                              << " are not made: " << error.what());
  }
  // With another number, the surface takes over this body at once, and does not wait for a cut that never
  // comes.
  keepOwnBody();
}

/// @throw std::invalid_argument if they are of another object, or cannot be made.
void SimulatorNode::adopt(const EditedBody& theirs) {
  if (!sameRestBody(theirs.uncut, body_.uncutVolume()))
    throw std::invalid_argument("they are of another object");
  const std::string refusal = refusalOf(theirs.edits, body_.edits());
  if (!refusal.empty()) throw std::invalid_argument(refusal);
  const bool skips = theirs.edits.revision > body_.edits().revision + 1;
  body_.adopt(theirs.edits);
  if (skips) {
    ROS_INFO("taken over from the surface: revision %u with %zu strokes of cuts", theirs.edits.revision,
             theirs.edits.in_force);
  }
}

void SimulatorNode::keepOwnBody() {
  body_.setBody(ros::WallTime::now().toNSec());
  publishOwnEdits();
}

/// The other nodes follow this body.
void SimulatorNode::publishOwnEdits() {
  publisher_.publishEdited(body_, simulator_.placed() ? last_.header.stamp : ros::Time());
}

void SimulatorNode::publishEdited(const ros::Time& stamp) {
  surroundings_.updatePins(simulator_.topology(), simulator_.state().vertices);
  // Only before the body is placed the stamp is 0: then the topology gets the stamp of the first frame.
  const ros::Time& of_frame = stamp.isZero() ? last_.header.stamp : stamp;
  publisher_.publishEdited(body_, simulator_.placed() ? of_frame : ros::Time());
  last_.set = simulator_.toCurrentRevision(std::move(last_.set));
  // After several edits at once the earlier targets cannot be found again.
  if (last_.set.revision != simulator_.topology().revision) last_.set.targets.clear();
  last_.set.revision = simulator_.topology().revision;
  malloc_trim(0);  // returns the memory of the model before the edit
}

/// What is new in the options takes effect with the next step.
void SimulatorNode::applyOptions(const SimulatorOptions& next) {
  if (isOther(materialParameters(), next.material, options_.material))
    simulator_.change(withParameters(simulator_.material(), next.material), next.simulator);
  else if (isOther(simulatorParameters(), next.simulator, options_.simulator))
    simulator_.setConfig(next.simulator);
}

/// Also with the present values: estimated loads are forgotten.
bool SimulatorNode::onSetMaterial(softbody_msgs::SetMaterial::Request& request,
                                  softbody_msgs::SetMaterial::Response& response) try {
  simulator_.setMaterial(withParameters(
      simulator_.material(),
      {request.youngs_modulus_pa, request.poisson_ratio, request.density_kg_m3, request.damping}));
  options_.material = parametersOf(simulator_.material());
  live_parameters_.publishChanges();
  response.success = 1;
  return true;
} catch (const std::invalid_argument& error) {
  response.message = error.what();
  return true;
}

/// Its targets have a later revision than those that are still on their way.
void SimulatorNode::useObject(NextObject* next) {
  const TetTopology& topology = next->simulator.topology();
  if (topology.revision != simulator_.topology().revision + 1)
    throw std::runtime_error("the body was cut while the object was loaded; load the object again");
  if (isOther(simulatorParameters(), next->simulator.config(), options_.simulator))
    next->simulator.setConfig(options_.simulator);  // changed while the object was loaded
  surroundings_.replacePins(next->surface, next->pins, topology);
  simulator_ = std::move(next->simulator);
  body_ = makeBody();
  options_.material = parametersOf(simulator_.material());
  live_parameters_.publishChanges();
  last_ = {};
  keepOwnBody();
  malloc_trim(0);  // returns the memory of the object before
  ROS_INFO("another object is simulated, from revision %u on", simulator_.topology().revision);
}

void SimulatorNode::publishState(const std_msgs::Header& header) {
  publisher_.publishState(simulator_.state(), header);
  Reactions reactions = simulator_.reactions();
  try {
    const auto scope = timer_.stage("Forces");
    forces_.publish(last_.set, header, surroundings_, &simulator_, &reactions);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_THROTTLE(1.0, "external forces are not known: " << error.what());
  }
  surroundings_.publishReactions(reactions, header.stamp);
  publisher_.publishTiming(timer_.take(), header);
}

}  // namespace softbody
