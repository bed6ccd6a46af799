#include "elastic/embedded_body.h"

#include <Eigen/Dense>

namespace softbody::virtual_camera {
namespace {

constexpr double kUsualDensity = 30.0;  // [kg/m^3]

}  // namespace

EmbeddedBody::EmbeddedBody(const TriangleMesh& rest, const Elasticity& elasticity,
                           const Eigen::Vector3d& cell_m)
    : rest_(rest.vertices),
      elasticity_(elasticity),
      solid_(fillWithCells(rest, cell_m),
             StableNeoHookean(elasticity.youngs_modulus_pa, elasticity.poisson_ratio)) {
  for (Eigen::Index i = 0; i < rest_.rows(); ++i) places_.push_back(solid_.grid().embed(rest_.row(i)));
}

TrueMaterial EmbeddedBody::material() const {
  TrueMaterial material{elasticity_, solid_.nodalVolumes().sum()};
  material.elasticity.density_kg_m3 = elasticity_.density_kg_m3.value_or(kUsualDensity);
  return material;
}

Points EmbeddedBody::surface(const Points& moved) const {
  Points vertices = rest_;
  for (Eigen::Index i = 0; i < vertices.rows(); ++i)
    vertices.row(i) += places_[static_cast<std::size_t>(i)].in(moved).transpose();
  return vertices;
}

}  // namespace softbody::virtual_camera
