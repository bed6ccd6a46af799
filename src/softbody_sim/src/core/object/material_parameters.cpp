#include "softbody_sim/object/material_parameters.h"

namespace softbody {
namespace {

Range rangeOf(const MaterialRange& range) { return {range.min, range.max}; }

ParameterTable<MaterialParameters> makeMaterialTable() {
  using Values = MaterialParameters;
  constexpr char kOwn[] = "the object's";
  ParameterTable<Values> table;
  table.group("simulator");
  table.number("youngs_modulus_pa", &Values::youngs_modulus_pa, rangeOf(kYoungsModulusRange), "Pa", kOwn,
               "stiffness of the whole body; [regions](../your_own_object.md#4-the-material) keep theirs",
               Change::kLive);
  table.number("poisson_ratio", &Values::poisson_ratio, rangeOf(kPoissonRatioRange), "", kOwn,
               "Poisson's ratio of the whole body; regions keep theirs", Change::kLive);
  table.number("density_kg_m3", &Values::density_kg_m3, rangeOf(kDensityRange), "kg/m³", kOwn,
               "density of the whole body; regions keep theirs", Change::kLive);
  table.number("damping", &Values::damping, rangeOf(kDampingRange), "", kOwn,
               "fraction of the velocity that is lost per 1/30 s", Change::kLive);
  return table;
}

}  // namespace

const ParameterTable<MaterialParameters>& materialParameters() {
  static const ParameterTable<MaterialParameters> table = makeMaterialTable();
  return table;
}

Material withParameters(Material material, const MaterialParameters& values) {
  if (values.youngs_modulus_pa && *values.youngs_modulus_pa != material.youngs_modulus_pa)
    material.youngs_modulus_std_pa.reset();
  material.youngs_modulus_pa = values.youngs_modulus_pa.value_or(material.youngs_modulus_pa);
  material.poisson_ratio = values.poisson_ratio.value_or(material.poisson_ratio);
  material.density_kg_m3 = values.density_kg_m3.value_or(material.density_kg_m3);
  material.damping = values.damping.value_or(material.damping);
  return material;
}

MaterialParameters parametersOf(const Material& material) {
  return {material.youngs_modulus_pa, material.poisson_ratio, material.density_kg_m3, material.damping};
}

}  // namespace softbody
