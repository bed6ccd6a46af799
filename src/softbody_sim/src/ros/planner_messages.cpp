#include "ros/planner_messages.h"

#include <sensor_msgs/point_cloud2_iterator.h>

#include <limits>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {

shape_msgs::Mesh makeSurfaceMesh(const MeshTopology& topology, const MeshState& state) {
  shape_msgs::Mesh mesh;
  mesh.triangles.resize(static_cast<std::size_t>(topology.triangles.rows()));
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      mesh.triangles[f].vertex_indices[static_cast<std::size_t>(k)] =
          static_cast<std::uint32_t>(topology.triangles(static_cast<Eigen::Index>(f), k));
    }
  }
  mesh.vertices.reserve(static_cast<std::size_t>(state.vertices.rows()));
  for (const auto& vertex : state.vertices.rowwise())
    mesh.vertices.push_back(pointMessage(vertex.transpose()));
  return mesh;
}

sensor_msgs::PointCloud2 makeSurfaceCloud(const MeshTopology& topology, const MeshState& state) {
  using sensor_msgs::PointField;
  constexpr auto kFloat = PointField::FLOAT32;
  sensor_msgs::PointCloud2 cloud;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2Fields(8, "x", 1, kFloat, "y", 1, kFloat, "z", 1, kFloat, "normal_x", 1, kFloat,
                                "normal_y", 1, kFloat, "normal_z", 1, kFloat, "confidence", 1, kFloat,
                                "standard_deviation", 1, kFloat);
  modifier.resize(static_cast<std::size_t>(state.vertices.rows()));
  const Points normals = vertexNormals(state.vertices, topology.triangles);
  const bool has_deviation = !state.standard_deviation.empty();
  sensor_msgs::PointCloud2Iterator<float> out(cloud, "x");
  for (Eigen::Index v = 0; v < state.vertices.rows(); ++v, ++out) {
    const auto k = static_cast<std::size_t>(v);
    for (int axis = 0; axis < 3; ++axis) {
      out[axis] = static_cast<float>(state.vertices(v, axis));
      out[3 + axis] = static_cast<float>(normals(v, axis));
    }
    out[6] = state.confidence[k];
    out[7] = has_deviation ? state.standard_deviation[k] : std::numeric_limits<float>::quiet_NaN();
  }
  cloud.is_dense = true;
  return cloud;
}

}  // namespace softbody
