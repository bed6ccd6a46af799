#pragma once

#include <Eigen/Core>
#include <vector>

#include "elasticity/lame_parameters.h"
#include "softbody_common/geometry/types.h"

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

/// A material, and which fractions of its energy are smoothed.
struct ElasticMaterial {
  Lame lame;
  Smoothing smoothing;
};

/// The part of a material that takes its strain from the tets, and the part that takes it from the patches
/// around the vertices. Together they are the material.
Lame tetPart(const ElasticMaterial& material);
Lame patchPart(const ElasticMaterial& material);

/// The elastic materials of a body.
struct ElasticMaterials {
  /// The same everywhere.
  ElasticMaterials(const Lame& lame, const Smoothing& smoothing = {}) : kinds{{lame, smoothing}} {}

  int kindOf(Eigen::Index tet) const { return of_tets.empty() ? 0 : of_tets[static_cast<std::size_t>(tet)]; }
  const ElasticMaterial& of(Eigen::Index tet) const { return kinds[static_cast<std::size_t>(kindOf(tet))]; }

  std::vector<ElasticMaterial> kinds;
  std::vector<int> of_tets;  ///< #T: index of the kind; empty: all have the first
};

/// Deformation gradients averaged over the tets around each vertex (node-based smoothed finite elements: Liu,
/// Nguyen-Thoi, Nguyen-Xuan, Lam 2009): F_p = sum_i x_i g_i^T over the vertices i of those tets. A linear tet
/// has a single strain and locks in bending; the average does not. Where materials meet, strain jumps. So the
/// tets of each kind around a vertex are a patch of their own.
struct SmoothedGradients {
  std::vector<int> first;      ///< #P + 1: first row of each patch in `vertices` and `gradients`
  std::vector<int> vertices;   ///< i, ascending in each patch
  Eigen::MatrixX3d gradients;  ///< g_i [1/m]
  Eigen::VectorXd volumes;     ///< #P, a quarter of the volume of the patch's tets [m^3]
  std::vector<int> kinds;      ///< #P, of the material
};

/// @param tets of positive volume; every vertex belongs to one. @return with one kind, patch v is that around
/// vertex v.
SmoothedGradients smoothedGradients(const Points& rest_vertices, const Tets& tets,
                                    const ElasticMaterials& materials);

/// Whether any energy is in the patches.
bool hasPatches(const ElasticMaterials& materials);

}  // namespace softbody
