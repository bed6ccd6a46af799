#pragma once

#include <optional>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_sim/object/material.h"

namespace softbody {

/// Values that replace those of the object's material. Regions keep their own.
struct MaterialParameters {
  std::optional<double> youngs_modulus_pa, poisson_ratio, density_kg_m3, damping;
};

const ParameterTable<MaterialParameters>& materialParameters();

/// The material with the given values. With another Young's modulus, its standard deviation goes.
Material withParameters(Material material, const MaterialParameters& values);

/// All values of a material.
MaterialParameters parametersOf(const Material& material);

}  // namespace softbody
