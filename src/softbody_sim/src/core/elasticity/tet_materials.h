#pragma once

#include <Eigen/Core>
#include <optional>

#include "elasticity/strain_smoothing.h"
#include "softbody_common/geometry/types.h"
#include "softbody_sim/object/material.h"

namespace softbody {

/// The material of each tet.
struct TetMaterials {
  ElasticMaterials elastic;
  Eigen::VectorXd densities;         ///< #T [kg/m^3]
  double mean_youngs_modulus_pa;     ///< over the volume
  double largest_youngs_modulus_pa;  ///< of all tets
};

/// @param strain_smoothing, @param volume_smoothing as Smoothing; without the latter, each material has its
/// volumeSmoothing(). @throw std::invalid_argument if the topology has no tets.
TetMaterials tetMaterials(const TetTopology& topology, const Material& material, double strain_smoothing,
                          const std::optional<double>& volume_smoothing);

/// @throw std::invalid_argument that names the first region of the material without a tet of its own.
void requireUsedRegions(const TetTopology& topology, const Material& material);

}  // namespace softbody
