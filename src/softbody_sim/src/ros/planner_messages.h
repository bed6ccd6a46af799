#pragma once

#include <sensor_msgs/PointCloud2.h>
#include <shape_msgs/Mesh.h>

#include "softbody_common/geometry/types.h"

/// The surface as standard messages, for motion planners. The caller sets the headers.
namespace softbody {

/// The vertices of a state with the triangles of its topology.
shape_msgs::Mesh makeSurfaceMesh(const MeshTopology& topology, const MeshState& state);

/// The vertices of a state, in order. Fields: x y z [m], normal_x normal_y normal_z (unit, outward),
/// confidence (0 to 1), standard_deviation ([m]; NaN: not estimated).
sensor_msgs::PointCloud2 makeSurfaceCloud(const MeshTopology& topology, const MeshState& state);

}  // namespace softbody
