#include "softbody_scanning/surface/iso_surface.h"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/VolumeToMesh.h>

namespace softbody::scanning {
namespace {

openvdb::FloatGrid::Ptr toVdb(const DistanceGrid& grid) {
  openvdb::initialize();
  auto vdb = openvdb::FloatGrid::create(static_cast<float>(grid.box.reach_m));
  vdb->setGridClass(openvdb::GRID_LEVEL_SET);
  const openvdb::CoordBBox box(openvdb::Coord(0, 0, 0),
                               openvdb::Coord(grid.size.x() - 1, grid.size.y() - 1, grid.size.z() - 1));
  const openvdb::tools::Dense<const float, openvdb::tools::LayoutXYZ> dense(box, grid.distances.data());
  openvdb::tools::copyFromDense(dense, *vdb, 0.0f);
  return vdb;
}

}  // namespace

TriangleMesh isoSurface(const DistanceGrid& grid) {
  std::vector<openvdb::Vec3s> points;
  std::vector<openvdb::Vec3I> triangles;
  std::vector<openvdb::Vec4I> quads;
  openvdb::tools::volumeToMesh(*toVdb(grid), points, triangles, quads, 0.0, 0.0);
  TriangleMesh mesh{Points(static_cast<Eigen::Index>(points.size()), 3),
                    Triangles(static_cast<Eigen::Index>(triangles.size() + 2 * quads.size()), 3)};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d index(points[i].x(), points[i].y(), points[i].z());
    mesh.vertices.row(static_cast<Eigen::Index>(i)) = grid.box.box.min() + grid.box.voxel_m * index;
  }
  Eigen::Index next = 0;
  const auto add = [&](unsigned a, unsigned b, unsigned c) {  // OpenVDB's triangles face inward
    mesh.triangles.row(next++) << static_cast<int>(a), static_cast<int>(c), static_cast<int>(b);
  };
  for (const openvdb::Vec3I& t : triangles) add(t[0], t[1], t[2]);
  for (const openvdb::Vec4I& q : quads) {
    add(q[0], q[1], q[2]);
    add(q[0], q[2], q[3]);
  }
  return mesh;
}

}  // namespace softbody::scanning
