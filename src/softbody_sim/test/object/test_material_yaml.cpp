#include <test_support/gtest.h>

#include "fixtures/object_model_test.h"
#include "softbody_sim/object/material_yaml.h"

namespace softbody {
namespace {

class MaterialYaml : public test::ObjectModelTest {
 protected:
  MaterialYaml() { describe(test::torus(0.1, 0.03, 12, 8)); }

  /// Writes a material into a YAML; what is read from it then.
  Material roundTrip(const std::string& text, const Material& material, std::string* result) {
    *result = withMaterial(text, material, "object.yaml");
    return loadObjectDescription(yaml(*result)).material;
  }
};

void expectEqual(const Material& a, const Material& b) {
  EXPECT_NEAR(a.youngs_modulus_pa, b.youngs_modulus_pa, 1e-5 * b.youngs_modulus_pa);
  EXPECT_NEAR(a.poisson_ratio, b.poisson_ratio, 1e-5);
  EXPECT_NEAR(a.density_kg_m3, b.density_kg_m3, 1e-4 * b.density_kg_m3);
  EXPECT_NEAR(a.damping, b.damping, 1e-5);
  EXPECT_EQ(a.youngs_modulus_std_pa.has_value(), b.youngs_modulus_std_pa.has_value());
  if (a.youngs_modulus_std_pa && b.youngs_modulus_std_pa) {
    EXPECT_NEAR(*a.youngs_modulus_std_pa, *b.youngs_modulus_std_pa, 1e-5 * *b.youngs_modulus_std_pa);
  }
  ASSERT_EQ(a.regions.size(), b.regions.size());
  for (std::size_t k = 0; k < a.regions.size(); ++k)
    EXPECT_NEAR(a.regions[k].youngs_modulus_pa, b.regions[k].youngs_modulus_pa,
                1e-5 * b.regions[k].youngs_modulus_pa);
}

const Material kFound{12345.6, 0.31, 123.0, 0.2, {}, 567.8};

TEST_F(MaterialYaml, ValuesAreReplacedAndTheRestStays) {
  const std::string before = "# the body\nobject:\n  visual_mesh: visual.obj  # seen\n",
                    after = "\n  # where it lies\n  initial_pose: [0, 0, 0.5, 0, 0, 0, 1]\n";
  for (const std::string material :
       {"  material: {youngs_modulus_pa: 2.0e4, poisson_ratio: 0.2, density_kg_m3: 30, damping: 0.1}",
        "  material: {damping: 0.1}", "  material: {}", "  material: {youngs_modulus_std: 5}",
        "  material: {youngs_modulus_pa: 1e4, youngs_modulus_std_pa: 5}",
        "  material: {youngs_modulus_std_pa: 5, youngs_modulus_pa: 1e4}",
        "  material:\n    youngs_modulus_pa: 2.0e4\n    youngs_modulus_std: 3 # old\n    damping: 0.3",
        "  material:\n    damping: '0.3'"}) {
    std::string result;
    expectEqual(roundTrip(before + material + after, kFound, &result), kFound);
    EXPECT_EQ(result.substr(0, before.size()), before);
    EXPECT_EQ(result.substr(result.size() - after.size()), after);
  }
}

TEST_F(MaterialYaml, AMissingMaterialIsAdded) {
  std::string result;
  expectEqual(roundTrip("object:\n  visual_mesh: visual.obj\n", kFound, &result), kFound);
  expectEqual(roundTrip("object: {visual_mesh: visual.obj}\n", kFound, &result), kFound);
}

TEST_F(MaterialYaml, ADeviationThatIsNotKnownGoes) {
  Material unknown = kFound;
  unknown.youngs_modulus_std_pa.reset();
  std::string result;
  expectEqual(roundTrip("object:\n  visual_mesh: visual.obj\n  material: {youngs_modulus_std_pa: 5}\n",
                        unknown, &result),
              unknown);
  EXPECT_FALSE(says(result, "std"));
}

TEST_F(MaterialYaml, RegionsKeepTheirBoxes) {
  Material found = kFound;
  found.regions.push_back({Eigen::Vector3d::Zero(), Eigen::Vector3d::Ones(), 777.0, 0.4, 55.0});
  std::string result;
  const Material read = roundTrip(
      "object:\n  visual_mesh: visual.obj\n  materials:\n  - {min: [0, 0, 0], max: [1, 1, 1], "
      "youngs_modulus_pa: 3}\n",
      found, &result);
  expectEqual(read, found);
  EXPECT_EQ(read.regions.at(0).max.x(), 1.0);
}

TEST_F(MaterialYaml, WhatIsNoObjectIsRefused) {
  EXPECT_THROW(withMaterial("tool: {}\n", kFound, "x.yaml"), std::invalid_argument);
  EXPECT_THROW(withMaterial("object: {material: 3}\n", kFound, "x.yaml"), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
