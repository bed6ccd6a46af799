#include "softbody_evaluation/ros/simulate_truth.h"

#include <fmt/format.h>
#include <std_msgs/Header.h>

#include <stdexcept>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_evaluation/measures/vertex_match.h"
#include "softbody_evaluation/ros/surface_reader.h"
#include "softbody_recordings/ros/atomic_bag.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/interpolation/visual_surface.h"
#include "softbody_sim/object/object_model.h"
#include "softbody_virtual_camera/ros/messages.h"

namespace softbody::evaluation {
namespace {

constexpr char kBodyFrame[] = "softbody";
constexpr double kFirm = 100.0;  // weight of a target; errors are then hundredths of a millimetre

SurfaceRecord readTrueSurface(const std::string& path) {
  SurfaceRecord truth = readSurface(path, std::string("/") + virtual_camera::kTruthTopologyTopic,
                                    std::string("/") + virtual_camera::kTruthStateTopic);
  if (truth.topologies.size() != 1 || truth.topologies.begin()->first != 0)
    throw std::invalid_argument(path + ": the body is cut; only a body without cuts can be simulated");
  return truth;
}

void requireSame(const MeshTopology& object, const MeshTopology& truth,
                 const TruthSimulationOptions& options) {
  if (sameMesh(object, truth)) return;
  throw std::invalid_argument(
      fmt::format("{} is not the mesh of the truth in {}: at rest, vertices of the same index have different "
                  "positions",
                  options.object, options.truth));
}

SimulatorConfig convergedConfig() {
  SimulatorConfig config;
  config.iterations = 300;
  config.tolerance = 1e-6;
  return config;
}

class TruthSimulation {
 public:
  TruthSimulation(const TruthSimulationOptions& options, const ObjectModel& model)
      : truth_(readTrueSurface(options.truth)),
        simulator_(model.volume, model.material, convergedConfig()),
        surface_(model.visual, model.volume),
        bag_(options.output) {
    requireSame(surface_.topology(), truthTopology(), options);
    own_vertex_ = matchVertices(truthTopology().vertex_parents, surface_.topology().vertex_parents);
  }

  void run(const std::function<void(double)>& progress) {
    std::size_t done = 0;
    for (const auto& [stamp, state] : truth_.states) {
      simulator_.step(exactTargets(state, done == 0), stamp);
      write(stamp);
      progress(static_cast<double>(++done) / static_cast<double>(truth_.states.size()));
    }
    bag_.finish();
  }

 private:
  const MeshTopology& truthTopology() const { return truth_.topologies.begin()->second; }

  TargetSet exactTargets(const MeshState& truth, bool first) const {
    TargetSet set;
    set.reset = first;
    set.body_pose = fitRigid(truthTopology().rest_vertices, truth.vertices);
    for (std::size_t v = 0; v < truth.confidence.size(); ++v) {
      if (truth.confidence[v] <= 0.5f || own_vertex_[v] < 0) continue;
      Target target;
      target.place = surface_.binding().places()[static_cast<std::size_t>(own_vertex_[v])];
      target.position = truth.vertices.row(static_cast<Eigen::Index>(v));
      target.weight = kFirm;
      set.targets.push_back(target);
    }
    return set;
  }

  void write(Nanoseconds stamp) {
    std_msgs::Header header;
    header.stamp = toTime(stamp);
    header.frame_id = truth_.frame_id;
    writeTopology(header.stamp);
    softbody_msgs::MeshState state = toMessage(surface_.apply(simulator_.state()));
    state.header = header;
    bag_.write(std::string("/softbody/") + topics::kSurfaceState, header.stamp, state);
  }

  /// At first and every second.
  void writeTopology(const ros::Time& stamp) {
    if (!topology_written_.isZero() && secondsBetween(topology_written_, stamp) < 1.0) return;
    topology_written_ = stamp;
    softbody_msgs::MeshTopology topology = toMessage(surface_.topology());
    topology.header.frame_id = kBodyFrame;
    topology.header.stamp = toTime(truth_.states.begin()->first);
    bag_.writeLatched(std::string("/softbody/") + topics::kSurfaceTopology, stamp, topology);
  }

  SurfaceRecord truth_;
  Simulator simulator_;
  VisualSurface surface_;
  AtomicBag bag_;
  ros::Time topology_written_;
  std::vector<int> own_vertex_;  ///< by vertex of the truth; -1: none
};

}  // namespace

void simulateTruth(const TruthSimulationOptions& options, const std::function<void(double)>& progress) {
  TruthSimulation(options, buildObjectModel(loadObjectDescription(options.object, options.scope)))
      .run(progress);
}

}  // namespace softbody::evaluation
