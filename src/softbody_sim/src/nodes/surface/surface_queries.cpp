#include "nodes/surface/surface_queries.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "softbody_common/files/staged_output.h"
#include "softbody_common/geometry/plausibility.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_sim/io/surface_files.h"
#include "surface_mesh/closest_surface_point.h"

namespace softbody {
namespace {

constexpr std::size_t kLongestFileName = 100;  // file systems allow 255 bytes

/// A name without folders, so that a client cannot write elsewhere.
void requireObjName(const std::string& name) {
  const std::string ending = ".obj";
  const bool has_stem = name.size() > ending.size() && name.size() <= kLongestFileName && name.front() != '.';
  const bool plain = std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
  if (has_stem && plain && name.compare(name.size() - ending.size(), ending.size(), ending) == 0) return;
  throw std::invalid_argument(
      fmt::format("name is '{}'; allowed: a file name without folders, up to {} letters, digits, _, - and ., "
                  "that ends in "
                  ".obj and does not start with a dot",
                  name.substr(0, kLongestFileName), kLongestFileName));
}

Eigen::Vector3d plausiblePoint(const geometry_msgs::Point& p) {
  const Eigen::Vector3d point(p.x, p.y, p.z);
  if (isPlausible(point)) return point;
  throw std::invalid_argument(fmt::format("point is ({:.6g}, {:.6g}, {:.6g}); allowed: -{:g} to {:g} m", p.x,
                                          p.y, p.z, kLargestCoordinate_m, kLargestCoordinate_m));
}

}  // namespace

SurfaceQueries::SurfaceQueries(ros::NodeHandle private_node, std::string save_folder)
    : save_folder_(std::move(save_folder)),
      closest_point_(private_node.advertiseService("closest_point", &SurfaceQueries::onClosestPoint, this)),
      save_mesh_(private_node.advertiseService("save_mesh", &SurfaceQueries::onSaveMesh, this)) {}

void SurfaceQueries::show(const MeshTopology* topology, MeshState state, const std_msgs::Header& header) {
  shown_ = Shown{topology, std::move(state), header};
}

const SurfaceQueries::Shown& SurfaceQueries::shown() const {
  if (shown_) return *shown_;
  throw std::invalid_argument("there is no state of the surface yet: the body is not tracked");
}

/// In the frame of the state.
Eigen::Isometry3d SurfaceQueries::poseOf(const std::string& frame) const {
  const std_msgs::Header& header = shown().header;
  if (const auto found = poses_.find(frame, header.frame_id, header.stamp)) return found->pose;
  throw std::invalid_argument(
      fmt::format("tf does not know the pose of frame '{}' in '{}'", frame, header.frame_id));
}

bool SurfaceQueries::onClosestPoint(softbody_msgs::ClosestPoint::Request& request,
                                    softbody_msgs::ClosestPoint::Response& response) try {
  const Shown& last = shown();
  const std::string frame = frameName(request.point.header.frame_id, "closest_point");
  const Eigen::Isometry3d pose = poseOf(frame);
  const Eigen::Vector3d point = plausiblePoint(request.point.point);
  const ClosestSurfacePoint closest = closestSurfacePoint(*last.topology, last.state, pose * point);
  const Eigen::Vector3d position = pose.inverse() * closest.position;
  const Eigen::Vector3d normal = pose.linear().transpose() * closest.normal;
  response.surface_point.header.frame_id = frame.empty() ? last.header.frame_id : frame;
  response.surface_point.header.stamp = last.header.stamp;
  response.surface_point.point = pointMessage(position);
  response.normal.x = normal.x();
  response.normal.y = normal.y();
  response.normal.z = normal.z();
  response.distance = (position - point).norm();
  response.revision = last.state.revision;
  response.piece = closest.piece;
  response.triangle = static_cast<std::uint32_t>(closest.triangle);
  response.confidence = closest.confidence;
  response.standard_deviation = closest.standard_deviation;
  response.success = 1;
  return true;
} catch (const std::invalid_argument& error) {
  response.message = error.what();
  return true;
}

bool SurfaceQueries::onSaveMesh(softbody_msgs::SaveMesh::Request& request,
                                softbody_msgs::SaveMesh::Response& response) try {
  save(request.name, &response);
  response.success = 1;
  return true;
} catch (const std::exception& error) {
  response.message = error.what();
  return true;
}

void SurfaceQueries::save(const std::string& name, softbody_msgs::SaveMesh::Response* response) const {
  requireObjName(name);
  const Shown& last = shown();
  const std::filesystem::path path = std::filesystem::absolute(save_folder_) / name;
  if (std::filesystem::exists(path))
    throw std::invalid_argument(fmt::format("{} exists already; choose another name", path.string()));
  StagedFile file(path);
  writeObj(file.path(), {last.state.vertices, last.topology->triangles},
           {last.topology->texture_coordinates});
  file.commit();
  response->path = path;
  response->frame_id = last.header.frame_id;
  response->stamp = last.header.stamp;
}

}  // namespace softbody
