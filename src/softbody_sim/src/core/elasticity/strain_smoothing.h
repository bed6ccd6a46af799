#pragma once

#include <Eigen/Core>
#include <vector>

#include "elasticity/lame_parameters.h"
#include "softbody_common/types.h"

namespace softbody {

/// Fractions of the elastic energy whose strains are averaged around the vertices. The pressure of nearly
/// incompressible tets locks unless all of it is averaged (nodal pressure: Bonet and Burton 1998). The shear
/// keeps a share in the tets, which stabilises both averages (alpha finite elements: Liu, Nguyen-Thoi, Lam
/// 2008).
struct Smoothing {
  Smoothing(double both = 0.0) : strain(both), volume(both) {}
  Smoothing(double strain_in, double volume_in) : strain(strain_in), volume(volume_in) {}

  double strain;  ///< of the term with mu, in [0, 1)
  double volume;  ///< of the term with lambda, in [0, 1]
};

/// The share of the volume energy to smooth, by Poisson's ratio: 0.7 up to 0.2. Above, the stiffness of the
/// rest, relative to that of shear, falls with 1 - 2 nu: the less the volume may change, the less tets may
/// resist it.
double volumeSmoothing(double poisson_ratio);

/// A part of the elastic energy: its fraction of the volume, and its material.
struct EnergyShare {
  double volume;
  Lame lame;
};

/// The parts of the tets and of the patches around the vertices. Together they are the material. Without
/// energy in the patches their volume is 0.
EnergyShare tetShare(const Lame& lame, const Smoothing& smoothing);
EnergyShare patchShare(const Lame& lame, const Smoothing& smoothing);

/// Deformation gradients averaged over the tets around each vertex (node-based smoothed finite elements: Liu,
/// Nguyen-Thoi, Nguyen-Xuan, Lam 2009): F_v = sum_i x_i g_i^T over the vertices i of those tets. A linear tet
/// has a single strain and locks in bending; the average does not.
struct SmoothedGradients {
  std::vector<int> first;      ///< #V + 1: first row of each vertex in `vertices` and `gradients`
  std::vector<int> vertices;   ///< i, including v itself; symmetric: v is also a neighbour of i
  Eigen::MatrixX3d gradients;  ///< g_i [1/m]
  Eigen::VectorXd volumes;     ///< #V, a quarter of the volume of the tets around it [m^3]
};

/// @param tets of positive volume; every vertex belongs to one.
SmoothedGradients smoothedGradients(const Points& rest_vertices, const Tets& tets);

}  // namespace softbody
