#pragma once

#include "softbody_sim/object/object_model.h"

namespace softbody {

/// Quality measures of a prepared model, all measured on its final meshes.
struct ModelQuality {
  int visual_vertices = 0, visual_triangles = 0;
  int cage_vertices = 0, cage_triangles = 0;
  int tet_vertices = 0, tets = 0;
  double size = 0.0;                 ///< diagonal of the visual mesh's bounding box [m]
  double cage_volume = 0.0;          ///< [m^3]
  double visual_volume = 0.0;        ///< of a closed visual mesh [m^3]; 0 for an open one
  int outside = 0;                   ///< visual vertices outside of the tets
  double least_margin = 0.0;         ///< from a visual vertex to the cage [m]
  double mean_margin = 0.0;          ///< [m]
  double largest_margin = 0.0;       ///< [m]
  double smallest_tet = 0.0;         ///< signed volume [m^3]
  double smallest_dihedral = 0.0;    ///< [degrees]
  double dihedral_percentile = 0.0;  ///< 1st percentile of the smallest angles of the tets [degrees]
  double largest_dihedral = 0.0;     ///< [degrees]
  double edge_spread = 0.0;          ///< 95th over 5th percentile of the edge lengths of the cage
  double partition_error = 0.0;      ///< mean value coordinates: largest deviation of their sum from 1
  double reproduction_error = 0.0;   ///< largest error of a visual vertex from its mean value coordinates [m]
};

/// @throw std::invalid_argument if the volume's boundary is not closed.
ModelQuality measureModel(const ObjectModel& model);

/// The smallest and the largest dihedral angle of each tet, #T by 2 [degrees].
Eigen::MatrixX2d dihedralAngles(const TetMesh& mesh);

/// The boundary of the tets, without inner vertices.
TriangleMesh cageOf(const TetTopology& volume);

}  // namespace softbody
