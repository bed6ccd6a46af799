#include "softbody_common/ros/conversions.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "softbody_common/tet_topology_check.h"

namespace softbody {
namespace {

constexpr double kUnitTolerance = 1e-3;  // the values were rounded to float

geometry_msgs::Point32 toPoint32(const Eigen::Vector3d& p) {
  geometry_msgs::Point32 message;
  message.x = static_cast<float>(p.x());
  message.y = static_cast<float>(p.y());
  message.z = static_cast<float>(p.z());
  return message;
}

Eigen::Vector3d fromPoint32(const geometry_msgs::Point32& message) {
  return {message.x, message.y, message.z};
}

std::vector<geometry_msgs::Point32> toPoint32s(const Points& points) {
  std::vector<geometry_msgs::Point32> message(static_cast<std::size_t>(points.rows()));
  for (std::size_t i = 0; i < message.size(); ++i)
    message[i] = toPoint32(points.row(static_cast<Eigen::Index>(i)));
  return message;
}

Points fromPoint32s(const std::vector<geometry_msgs::Point32>& message, const char* field) {
  Points points(static_cast<Eigen::Index>(message.size()), 3);
  for (std::size_t i = 0; i < message.size(); ++i) {
    points.row(static_cast<Eigen::Index>(i)) = fromPoint32(message[i]);
    if (!points.row(static_cast<Eigen::Index>(i)).allFinite()) {
      throw std::invalid_argument(fmt::format("{}[{}] is not finite", field, i));
    }
  }
  return points;
}

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

}  // namespace

geometry_msgs::Point pointMessage(const Eigen::Vector3d& point) {
  geometry_msgs::Point message;
  message.x = point.x();
  message.y = point.y();
  message.z = point.z();
  return message;
}

geometry_msgs::Pose toMessage(const Eigen::Isometry3d& pose) {
  const Eigen::Quaterniond q(pose.linear());
  geometry_msgs::Pose message;
  message.position.x = pose.translation().x();
  message.position.y = pose.translation().y();
  message.position.z = pose.translation().z();
  message.orientation.x = q.x();
  message.orientation.y = q.y();
  message.orientation.z = q.z();
  message.orientation.w = q.w();
  return message;
}

Eigen::Isometry3d fromMessage(const geometry_msgs::Pose& message) {
  const Eigen::Quaterniond q(message.orientation.w, message.orientation.x, message.orientation.y,
                             message.orientation.z);
  const Eigen::Vector3d t(message.position.x, message.position.y, message.position.z);
  if (!t.allFinite() || !(std::abs(q.norm() - 1.0) < kUnitTolerance)) {
    throw std::invalid_argument(
        fmt::format("pose ({} {} {}; {} {} {} {}): not finite, or the quaternion is not of unit length",
                    t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()));
  }
  return Eigen::Translation3d(t) * q.normalized();
}

Points fromMessage(const geometry_msgs::Polygon& polygon) {
  Points corners(static_cast<Eigen::Index>(polygon.points.size()), 3);
  for (Eigen::Index i = 0; i < corners.rows(); ++i) {
    const geometry_msgs::Point32& p = polygon.points[static_cast<std::size_t>(i)];
    corners.row(i) << p.x, p.y, p.z;
  }
  return corners;
}

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
  const std::size_t n = message.rest_vertices.size();
  MeshTopology topology;
  topology.revision = message.revision;
  topology.rest_vertices = fromPoint32s(message.rest_vertices, "rest_vertices");
  topology.triangles = fromElements<Triangles>(message.triangles, n, "triangles");
  topology.vertex_parents = message.vertex_parents;
  topology.triangle_pieces = message.triangle_bodies;
  topology.cut.assign(message.cut_triangles.begin(), message.cut_triangles.end());
  topology.texture_coordinates = fromPoint32s(message.texture_coordinates, "texture_coordinates");
  requireSize(topology.vertex_parents.size(), n, "vertex_parents");
  requireSize(topology.triangle_pieces.size(), message.triangles.size(), "triangle_bodies");
  requireSize(topology.cut.size(), message.triangles.size(), "cut_triangles");
  if (topology.texture_coordinates.rows() != 0) {
    requireSize(message.texture_coordinates.size(), 3 * message.triangles.size(), "texture_coordinates");
  }
  return topology;
}

softbody_msgs::MeshState toMessage(const MeshState& state) {
  softbody_msgs::MeshState message;
  message.observed = toTime(state.observed);
  message.revision = state.revision;
  message.vertices = toPoint32s(state.vertices);
  message.confidence = state.confidence;
  return message;
}

MeshState fromMessage(const softbody_msgs::MeshState& message) {
  MeshState state;
  state.observed = toNanoseconds(message.observed);
  state.revision = message.revision;
  state.vertices = fromPoint32s(message.vertices, "vertices");
  state.confidence = message.confidence;
  requireSize(state.confidence.size(), message.vertices.size(), "confidence");
  for (std::size_t i = 0; i < state.confidence.size(); ++i) {
    if (!(state.confidence[i] >= 0.0f && state.confidence[i] <= 1.0f)) {
      throw std::invalid_argument(
          fmt::format("confidence[{}] is {}; allowed: 0 to 1", i, state.confidence[i]));
    }
  }
  return state;
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
  TargetSet targets;
  targets.revision = message.revision;
  targets.reset = message.reset;
  targets.body_pose = fromMessage(message.body_pose);
  targets.targets.reserve(message.targets.size());
  for (std::size_t i = 0; i < message.targets.size(); ++i) {
    const softbody_msgs::Target& in = message.targets[i];
    if (in.kind > softbody_msgs::Target::MANUAL) {
      throw std::invalid_argument(fmt::format("targets[{}]: kind {} is unknown", i, in.kind));
    }
    if (in.tet > static_cast<std::uint32_t>(std::numeric_limits<int>::max())) {
      throw std::invalid_argument(fmt::format("targets[{}]: tet {} is out of range", i, in.tet));
    }
    Target target;
    target.kind = static_cast<TargetKind>(in.kind);
    target.place.tet = static_cast<int>(in.tet);
    for (int k = 0; k < 4; ++k) target.place.barycentric[k] = in.barycentric[k];
    target.position = fromPoint32(in.position);
    target.normal = fromPoint32(in.normal);
    target.weight = in.weight;
    const bool finite = target.place.barycentric.allFinite() && target.position.allFinite() &&
                        target.normal.allFinite() && std::isfinite(target.weight);
    if (!finite || target.weight <= 0.0) {
      throw std::invalid_argument(fmt::format("targets[{}]: not finite, or its weight is not above 0", i));
    }
    if (std::abs(target.place.barycentric.sum() - 1.0) > kUnitTolerance) {
      throw std::invalid_argument(fmt::format("targets[{}]: its barycentric coordinates do not sum to 1", i));
    }
    const double length = target.normal.norm();
    if (length != 0.0 && std::abs(length - 1.0) > kUnitTolerance) {
      throw std::invalid_argument(
          fmt::format("targets[{}]: its normal is neither zero nor of unit length", i));
    }
    targets.targets.push_back(target);
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

Pinhole pinholeFromMessage(const sensor_msgs::CameraInfo& info) {
  const bool has_projection = info.P[0] != 0.0;
  Pinhole camera;
  camera.width = static_cast<int>(info.width);
  camera.height = static_cast<int>(info.height);
  camera.fx = has_projection ? info.P[0] : info.K[0];
  camera.fy = has_projection ? info.P[5] : info.K[4];
  camera.cx = has_projection ? info.P[2] : info.K[2];
  camera.cy = has_projection ? info.P[6] : info.K[5];
  if (camera.width <= 0 || camera.height <= 0) {
    throw std::invalid_argument(fmt::format("camera_info: the image size is {}x{}", info.width, info.height));
  }
  if (!std::isfinite(camera.cx) || !std::isfinite(camera.cy)) {
    throw std::invalid_argument(
        fmt::format("camera_info: the centre ({}, {}) is not finite", camera.cx, camera.cy));
  }
  if (!(camera.fx > 0.0 && camera.fy > 0.0 && std::isfinite(camera.fx * camera.fy))) {
    throw std::invalid_argument(
        fmt::format("camera_info: focal lengths fx {} and fy {} must be above 0 (is the camera calibrated?)",
                    camera.fx, camera.fy));
  }
  return camera;
}

sensor_msgs::CameraInfo toMessage(const Pinhole& camera) {
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(camera.width);
  info.height = static_cast<std::uint32_t>(camera.height);
  info.distortion_model = "plumb_bob";
  info.D.assign(5, 0.0);
  info.K = {camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0};
  info.R = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  info.P = {camera.fx, 0.0, camera.cx, 0.0, 0.0, camera.fy, camera.cy, 0.0, 0.0, 0.0, 1.0, 0.0};
  return info;
}

}  // namespace softbody
