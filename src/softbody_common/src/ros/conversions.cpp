#include "softbody_common/ros/conversions.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "softbody_common/geometry/plausibility.h"
#include "softbody_common/geometry/tet_topology_check.h"

namespace softbody {
namespace {

constexpr Nanoseconds kLongestWithoutImage = 3'600'000'000'000;

constexpr double kUnitTolerance = 1e-3;  // the values were rounded to float

/// Conversions of fixed-size index tuples (MeshTriangle, Tetrahedron).
template <typename Element, typename Matrix>
std::vector<Element> toElements(const Matrix& indices) {
  std::vector<Element> message(static_cast<std::size_t>(indices.rows()));
  for (std::size_t i = 0; i < message.size(); ++i) {
    for (Eigen::Index k = 0; k < indices.cols(); ++k) {
      message[i].vertex_indices[k] = static_cast<std::uint32_t>(indices(static_cast<Eigen::Index>(i), k));
    }
  }
  return message;
}

template <typename Matrix, typename Element>
Matrix fromElements(const std::vector<Element>& message, std::size_t vertex_count, const char* field) {
  Matrix indices(static_cast<Eigen::Index>(message.size()), Matrix::ColsAtCompileTime);
  for (std::size_t i = 0; i < message.size(); ++i) {
    for (Eigen::Index k = 0; k < indices.cols(); ++k) {
      const std::uint32_t vertex = message[i].vertex_indices[k];
      if (vertex >= vertex_count) {
        throw std::invalid_argument(
            fmt::format("{}[{}] names vertex {} of {}", field, i, vertex, vertex_count));
      }
      indices(static_cast<Eigen::Index>(i), k) = static_cast<int>(vertex);
    }
  }
  return indices;
}

void requireSize(std::size_t size, std::size_t expected, const char* field) {
  if (size != expected) {
    throw std::invalid_argument(fmt::format("{} has {} entries instead of {}", field, size, expected));
  }
}

void requireCount(std::size_t count, std::size_t most, const char* field) {
  if (count <= most) return;
  throw std::invalid_argument(fmt::format("{} has {} entries; allowed: up to {}", field, count, most));
}

/// Piece numbers begin at 0 without a gap, so each is less than the number of elements.
void requirePieces(const std::vector<std::uint32_t>& pieces, const char* field) {
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (pieces[i] < pieces.size()) continue;
    throw std::invalid_argument(
        fmt::format("{}[{}] is {}; allowed: below {}", field, i, pieces[i], pieces.size()));
  }
}

void requireFinite(const std::vector<geometry_msgs::Point32>& points, const char* field) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points[i].x) || !std::isfinite(points[i].y) || !std::isfinite(points[i].z))
      throw std::invalid_argument(fmt::format("{}[{}] is not finite", field, i));
  }
}

/// @throw std::invalid_argument without the target's index.
Target targetFrom(const softbody_msgs::Target& in) {
  if (in.kind > softbody_msgs::Target::PRIOR)
    throw std::invalid_argument(fmt::format("kind {} is unknown", in.kind));
  if (in.tet > static_cast<std::uint32_t>(std::numeric_limits<int>::max()))
    throw std::invalid_argument(fmt::format("tet {} is out of range", in.tet));
  Target target;
  target.kind = static_cast<TargetKind>(in.kind);
  target.place.tet = static_cast<int>(in.tet);
  for (int k = 0; k < 4; ++k) target.place.barycentric[k] = in.barycentric[k];
  target.position = fromPoint32(in.position);
  target.normal = fromPoint32(in.normal);
  target.weight = in.weight;
  if (!isPlausible(target.position)) {
    throw std::invalid_argument(
        fmt::format("its position is not finite or not within {:.0f} m of the origin", kLargestCoordinate_m));
  }
  if (!(std::abs(target.place.barycentric.sum() - 1.0) <= kUnitTolerance))
    throw std::invalid_argument("its barycentric coordinates do not sum to 1");
  const double length = target.normal.norm();
  if (length != 0.0 && !(std::abs(length - 1.0) <= kUnitTolerance))
    throw std::invalid_argument("its normal is neither zero nor of unit length");
  if (!(target.weight > 0.0 && std::isfinite(target.weight)))
    throw std::invalid_argument(fmt::format("its weight is {}; allowed: above 0", target.weight));
  return target;
}

}  // namespace

softbody_msgs::TetTopology toMessage(const TetTopology& topology) {
  softbody_msgs::TetTopology message;
  message.revision = topology.revision;
  message.rest_vertices = toPoint32s(topology.rest_vertices);
  message.tets = toElements<softbody_msgs::Tetrahedron>(topology.tets);
  message.surface_triangles = toElements<shape_msgs::MeshTriangle>(topology.surface);
  message.vertex_parents = topology.vertex_parents;
  message.tet_bodies = topology.tet_pieces;
  // An all-zero quaternion, as in a new message, means "unknown".
  if (topology.has_initial_pose) message.initial_pose = toMessage(topology.initial_pose);
  return message;
}

TetTopology fromMessage(const softbody_msgs::TetTopology& message) {
  const std::size_t n = message.rest_vertices.size();
  TetTopology topology;
  topology.revision = message.revision;
  topology.rest_vertices = fromPoint32s(message.rest_vertices, "rest_vertices");
  topology.tets = fromElements<Tets>(message.tets, n, "tets");
  topology.surface = fromElements<Triangles>(message.surface_triangles, n, "surface_triangles");
  topology.vertex_parents = message.vertex_parents;
  topology.tet_pieces = message.tet_bodies;
  requireSize(topology.vertex_parents.size(), n, "vertex_parents");
  requireSize(topology.tet_pieces.size(), message.tets.size(), "tet_bodies");
  const auto& q = message.initial_pose.orientation;
  topology.has_initial_pose = q.x != 0.0 || q.y != 0.0 || q.z != 0.0 || q.w != 0.0;
  if (topology.has_initial_pose) topology.initial_pose = fromMessage(message.initial_pose);
  requireWhole(topology);
  return topology;
}

softbody_msgs::MeshTopology toMessage(const MeshTopology& topology) {
  softbody_msgs::MeshTopology message;
  message.revision = topology.revision;
  message.rest_vertices = toPoint32s(topology.rest_vertices);
  message.triangles = toElements<shape_msgs::MeshTriangle>(topology.triangles);
  message.vertex_parents = topology.vertex_parents;
  message.triangle_bodies = topology.triangle_pieces;
  message.cut_triangles.assign(topology.cut.begin(), topology.cut.end());
  message.texture_coordinates = toPoint32s(topology.texture_coordinates);
  return message;
}

MeshTopology fromMessage(const softbody_msgs::MeshTopology& message) {
  const std::size_t n = message.rest_vertices.size(), triangles = message.triangles.size();
  if (triangles == 0) throw std::invalid_argument("triangles is empty");
  requireCount(triangles, kMostTriangles, "triangles");
  requireSize(message.vertex_parents.size(), n, "vertex_parents");
  requireSize(message.triangle_bodies.size(), triangles, "triangle_bodies");
  requireSize(message.cut_triangles.size(), triangles, "cut_triangles");
  requirePieces(message.triangle_bodies, "triangle_bodies");
  requireFinite(message.texture_coordinates, "texture_coordinates");
  if (!message.texture_coordinates.empty())
    requireSize(message.texture_coordinates.size(), 3 * triangles, "texture_coordinates");
  MeshTopology topology;
  topology.revision = message.revision;
  topology.rest_vertices = fromPoint32s(message.rest_vertices, "rest_vertices");
  topology.triangles = fromElements<Triangles>(message.triangles, n, "triangles");
  topology.vertex_parents = message.vertex_parents;
  topology.triangle_pieces = message.triangle_bodies;
  topology.cut.assign(message.cut_triangles.begin(), message.cut_triangles.end());
  topology.texture_coordinates.resize(static_cast<Eigen::Index>(message.texture_coordinates.size()), 3);
  for (std::size_t i = 0; i < message.texture_coordinates.size(); ++i)
    topology.texture_coordinates.row(static_cast<Eigen::Index>(i)) =
        fromPoint32(message.texture_coordinates[i]);
  return topology;
}

bool sameTopology(const softbody_msgs::TetTopology& a, const softbody_msgs::TetTopology& b) {
  return &a == &b || (a.revision == b.revision && a.rest_vertices == b.rest_vertices && a.tets == b.tets &&
                      a.surface_triangles == b.surface_triangles && a.vertex_parents == b.vertex_parents &&
                      a.tet_bodies == b.tet_bodies);
}

bool sameTopology(const softbody_msgs::MeshTopology& a, const softbody_msgs::MeshTopology& b) {
  return &a == &b ||
         (a.revision == b.revision && a.rest_vertices == b.rest_vertices && a.triangles == b.triangles &&
          a.vertex_parents == b.vertex_parents && a.triangle_bodies == b.triangle_bodies &&
          a.cut_triangles == b.cut_triangles && a.texture_coordinates == b.texture_coordinates);
}

softbody_msgs::MeshState toMessage(const MeshState& state) {
  softbody_msgs::MeshState message;
  message.observed = toTime(state.observed);
  message.revision = state.revision;
  message.vertices = toPoint32s(state.vertices);
  message.confidence = state.confidence;
  message.standard_deviation = state.standard_deviation;
  return message;
}

namespace {

std::vector<float> standardDeviations(const softbody_msgs::MeshState& message) {
  const std::vector<float>& values = message.standard_deviation;
  if (!values.empty()) requireSize(values.size(), message.vertices.size(), "standard_deviation");
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= 0.0f && std::isfinite(values[i]))) {
      throw std::invalid_argument(
          fmt::format("standard_deviation[{}] is {}; allowed: 0 or more", i, values[i]));
    }
  }
  return values;
}

}  // namespace

MeshState fromMessage(const softbody_msgs::MeshState& message) {
  if (message.vertices.empty()) throw std::invalid_argument("vertices is empty");
  requireSize(message.confidence.size(), message.vertices.size(), "confidence");
  MeshState state;
  state.observed = toNanoseconds(message.observed);
  state.revision = message.revision;
  state.vertices = fromPoint32s(message.vertices, "vertices");
  state.confidence = message.confidence;
  for (std::size_t i = 0; i < state.confidence.size(); ++i) {
    if (!(state.confidence[i] >= 0.0f && state.confidence[i] <= 1.0f)) {
      throw std::invalid_argument(
          fmt::format("confidence[{}] is {}; allowed: 0 to 1", i, state.confidence[i]));
    }
  }
  state.standard_deviation = standardDeviations(message);
  return state;
}

ros::Time stampOfImage(const softbody_msgs::MeshState& message) {
  if (message.observed.isZero()) return message.header.stamp;
  const Nanoseconds without_image = toNanoseconds(message.header.stamp) - toNanoseconds(message.observed);
  if (without_image < 0 || without_image > kLongestWithoutImage) {
    throw std::invalid_argument(fmt::format("header.stamp is {:.3f} s after observed; allowed: 0 to {:.0f} s",
                                            seconds(without_image), seconds(kLongestWithoutImage)));
  }
  return message.observed;
}

softbody_msgs::Targets toMessage(const TargetSet& targets) {
  softbody_msgs::Targets message;
  message.revision = targets.revision;
  message.reset = targets.reset;
  message.body_pose = toMessage(targets.body_pose);
  message.targets.reserve(targets.targets.size());
  for (const Target& target : targets.targets) {
    softbody_msgs::Target out;
    out.kind = static_cast<std::uint8_t>(target.kind);
    out.tet = static_cast<std::uint32_t>(target.place.tet);
    for (int k = 0; k < 4; ++k) out.barycentric[k] = static_cast<float>(target.place.barycentric[k]);
    out.position = toPoint32(target.position);
    out.normal = toPoint32(target.normal);
    out.weight = static_cast<float>(target.weight);
    message.targets.push_back(out);
  }
  return message;
}

TargetSet fromMessage(const softbody_msgs::Targets& message) {
  requireCount(message.targets.size(), kMostTargets, "targets");
  TargetSet targets;
  targets.revision = message.revision;
  targets.reset = message.reset;
  targets.body_pose = fromMessage(message.body_pose);
  targets.targets.reserve(message.targets.size());
  for (std::size_t i = 0; i < message.targets.size(); ++i) {
    try {
      targets.targets.push_back(targetFrom(message.targets[i]));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("targets[{}]: {}", i, error.what()));
    }
  }
  return targets;
}

softbody_msgs::TrackingStatus toMessage(const TrackingStatus& status) {
  softbody_msgs::TrackingStatus message;
  message.state = static_cast<std::uint8_t>(status.state);
  message.features_tracked = status.features_tracked;
  message.features_total = status.features_total;
  message.inlier_ratio = static_cast<float>(status.inlier_ratio);
  message.residual_rms = static_cast<float>(status.residual_rms);
  message.reason = status.reason;
  return message;
}

softbody_msgs::StageTiming timingMessage(const std::string& node, const std::vector<StageTime>& stages) {
  softbody_msgs::StageTiming message;
  message.node = node;
  for (const StageTime& stage : stages) {
    softbody_msgs::StageTime row;
    row.stage = stage.stage;
    row.milliseconds = static_cast<float>(stage.milliseconds);
    row.initialization = stage.initialization;
    message.stages.push_back(row);
  }
  return message;
}

}  // namespace softbody
