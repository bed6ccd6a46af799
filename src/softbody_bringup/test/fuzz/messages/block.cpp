#include "fuzz/messages/block.h"

#include <fmt/format.h>

#include <algorithm>

#include "fuzz/messages/driven_node.h"
#include "fuzz/scratch_files.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"
#include "softbody_sim/cutting/patch/cut_shapes.h"

namespace softbody::fuzz {
namespace {

constexpr int kCells[] = {4, 2, 1};
constexpr double kCell_m = 0.025;
constexpr std::size_t kMostStrokes = 4;  // more of them make every cut slow

int vertexAt(int x, int y, int z) { return (x * (kCells[1] + 1) + y) * (kCells[2] + 1) + z; }

/// Kuhn's six tets of each cell: walks from its first corner to its last one, one axis at a time.
std::string tets() {
  constexpr int kAxes[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  std::string text;
  int count = 0;
  for (int cell = 0; cell < kCells[0] * kCells[1] * kCells[2]; ++cell) {
    for (int walk = 0; walk < 6; ++walk) {
      int at[] = {cell / (kCells[1] * kCells[2]), cell / kCells[2] % kCells[1], cell % kCells[2]};
      int corners[4] = {vertexAt(at[0], at[1], at[2])};
      for (int k = 0; k < 3; ++k) {
        ++at[kAxes[walk][k]];
        corners[k + 1] = vertexAt(at[0], at[1], at[2]);
      }
      if (walk >= 3) std::swap(corners[1], corners[2]);
      text += fmt::format("{} {} {} {} {}\n", ++count, corners[0] + 1, corners[1] + 1, corners[2] + 1,
                          corners[3] + 1);
    }
  }
  return fmt::format("*ELEMENTS\nTET\n{} 4 0\n", count) + text;
}

std::string vertices() {
  std::string text;
  int count = 0;
  for (int x = 0; x <= kCells[0]; ++x) {
    for (int y = 0; y <= kCells[1]; ++y) {
      for (int z = 0; z <= kCells[2]; ++z)
        text += fmt::format("{} {} {} {}\n", ++count, kCell_m * x, kCell_m * y, kCell_m * z);
    }
  }
  return fmt::format("*VERTICES\n{} 3 0 0\n", count) + text;
}

std::string visualMesh() {
  std::string text;
  for (int corner = 0; corner < 8; ++corner)
    text += fmt::format("v {} {} {}\n", kCell_m * kCells[0] * (corner & 1),
                        kCell_m * kCells[1] * (corner >> 1 & 1), kCell_m * kCells[2] * (corner >> 2));
  return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
}

Block makeBlock() {
  fileWith("block.obj", visualMesh());
  fileWith("block.veg", vertices() + tets());
  const std::string yaml =
      fileWith("block.yaml",
               "object:\n  visual_mesh: block.obj\n  tet_mesh: block.veg\n"
               "  material: {youngs_modulus_pa: 2.0e4, poisson_ratio: 0.2, density_kg_m3: 30, damping: 0.1}\n"
               "  initial_pose: [0, 0, 0.5, 0, 0, 0, 1]\n");
  return {yaml, buildObjectModel(loadObjectDescription(yaml))};
}

}  // namespace

const Block& block() {
  static const Block block = makeBlock();
  return block;
}

Eigen::Isometry3d blockPose() { return Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, 0.5)); }

softbody_msgs::Cut planeCut(std::uint32_t revision, std::uint32_t stroke, Choice* choice) {
  const auto coordinate = [&](int axis) {
    return kCell_m * kCells[axis] * (0.1 + 0.8 * static_cast<double>(choice->below(1000)) / 1000.0);
  };
  const Eigen::Vector3d point(coordinate(0), coordinate(1), coordinate(2));
  const Eigen::Vector3d normal(coordinate(0), coordinate(0) - 0.05, coordinate(0) - 0.05);
  Cut cut;
  cut.revision = revision;
  cut.stroke = stroke;
  cut.patch = planePatch(point, normal, block().model.volume.rest_vertices);
  return toMessage(cut);
}

XmlRpc::XmlRpcValue simulatorParameters() {
  XmlRpc::XmlRpcValue parameters;
  parameters["object"] = block().yaml;
  parameters["gripper"] = std::string("hand");
  parameters["save_folder"] = scratch().string();
  return parameters;
}

softbody_msgs::LoadObject::Request blockFile() {
  softbody_msgs::LoadObject::Request request;
  request.object = block().yaml;
  return request;
}

softbody_msgs::Targets blockTargets(const softbody_msgs::TetTopology& topology, bool reset, Choice* choice) {
  constexpr int kTargets = 12;
  softbody_msgs::Targets message;
  message.header.stamp = LoneRos::instance().now();
  message.header.frame_id = "camera_color_optical_frame";
  message.revision = topology.revision;
  message.reset = reset;
  message.body_pose = toMessage(blockPose());
  for (int k = 0; k < kTargets; ++k) {
    softbody_msgs::Target target;
    target.kind = softbody_msgs::Target::MANUAL;
    target.tet = static_cast<std::uint32_t>(choice->below(topology.tets.size()));
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (const std::uint32_t v : topology.tets[target.tet].vertex_indices)
      place += 0.25 * fromPoint32(topology.rest_vertices[v]);
    target.barycentric.assign(0.25f);
    target.position = toPoint32(blockPose() * place);
    target.weight = 1.0f;
    message.targets.push_back(target);
  }
  return message;
}

softbody_msgs::CutHistory editedFurther(softbody_msgs::CutHistory history, Choice* choice) {
  ++history.revision;
  history.stroke_is_open = 0;
  const std::size_t in_force = history.strokes_in_force;
  if (in_force > 0 && (choice->oneIn(3) || history.stroke_sizes.size() >= kMostStrokes)) {
    history.strokes_in_force = static_cast<std::uint32_t>(choice->below(in_force));
    return history;
  }
  std::size_t cuts = 0;
  for (std::size_t s = 0; s < in_force; ++s) cuts += history.stroke_sizes[s];
  history.stroke_sizes.resize(in_force);
  history.cuts.resize(cuts);
  history.cuts.push_back(planeCut(0, history.revision, choice));
  history.stroke_sizes.push_back(1);
  ++history.strokes_in_force;
  return history;
}

std::string whyOdd(const softbody_msgs::MeshState& state, const softbody_msgs::TetTopology& topology) {
  if (state.revision != topology.revision || state.vertices.size() != topology.rest_vertices.size())
    return fmt::format("a state of revision {} with {} vertices, but a topology of revision {} with {}",
                       state.revision, state.vertices.size(), topology.revision,
                       topology.rest_vertices.size());
  double farthest = 0.0;
  for (std::size_t v = 0; v < state.vertices.size(); ++v) {
    const double distance =
        (fromPoint32(state.vertices[v]) - blockPose() * fromPoint32(topology.rest_vertices[v])).norm();
    if (!(distance >= 0.0)) return "a state with a vertex that is not finite";
    farthest = std::max(farthest, distance);
  }
  constexpr double kFarthest_m = 0.02;  // gravity is small against the targets
  return farthest < kFarthest_m ? "" : fmt::format("the body is {:.3f} m from its targets", farthest);
}

}  // namespace softbody::fuzz
