#pragma once

#include "softbody_sim/object/object_model.h"

namespace softbody {

/// Measures of a prepared model. Everything is measured on the model as it is, nothing taken from how it was
/// made.
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
  double dihedral_percentile = 0.0;  ///< of the tets, 1 in 100 has a smaller smallest angle [degrees]
  double largest_dihedral = 0.0;     ///< [degrees]
  double edge_spread = 0.0;          ///< of the cage: its 95th percentile of edge lengths over the 5th
  double partition_error = 0.0;      ///< mean value coordinates: largest distance of their sum from 1
  double reproduction_error = 0.0;   ///< of a visual vertex by its mean value coordinates, largest [m]
};

/// @throw std::invalid_argument if the volume's boundary is not closed.
ModelQuality measureModel(const ObjectModel& model);

/// The smallest and the largest dihedral angle of each tet, #T by 2 [degrees].
Eigen::MatrixX2d dihedralAngles(const TetMesh& mesh);

/// The boundary's vertices alone, and its triangles.
TriangleMesh cageOf(const TetTopology& volume);

}  // namespace softbody
