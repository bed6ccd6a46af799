#include "elasticity/tet_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "elasticity/lame_parameters.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

/// Of each tet: 0, or one more than the index of its region.
std::vector<int> kindsOf(const TetTopology& topology, const std::vector<MaterialRegion>& regions) {
  std::vector<int> kinds(static_cast<std::size_t>(topology.tets.rows()), 0);
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    Eigen::Array3d center = Eigen::Array3d::Zero();
    for (int k = 0; k < 4; ++k)
      center += 0.25 * topology.rest_vertices.row(topology.tets(t, k)).transpose().array();
    for (std::size_t r = 0; r < regions.size(); ++r) {
      if ((center >= regions[r].min.array()).all() && (center <= regions[r].max.array()).all())
        kinds[static_cast<std::size_t>(t)] = static_cast<int>(r) + 1;
    }
  }
  return kinds;
}

}  // namespace

TetMaterials tetMaterials(const TetTopology& topology, const Material& material, double strain_smoothing,
                          const std::optional<double>& volume_smoothing) {
  if (topology.tets.rows() == 0) throw std::invalid_argument("the topology has no tets");
  std::vector<MaterialRegion> kinds = material.regions;
  const Eigen::Vector3d anywhere = Eigen::Vector3d::Zero();
  kinds.insert(kinds.begin(), {anywhere, anywhere, material.youngs_modulus_pa, material.poisson_ratio,
                               material.density_kg_m3});
  const std::vector<int> of_tets = kindsOf(topology, material.regions);
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  TetMaterials result{ElasticMaterials(Lame()), Eigen::VectorXd(volumes.size()), 0.0, 0.0};
  result.elastic.kinds.clear();
  for (const MaterialRegion& kind : kinds) {
    const double volume = volume_smoothing.value_or(volumeSmoothing(kind.poisson_ratio));
    result.elastic.kinds.push_back(
        {lameParameters(kind.youngs_modulus_pa, kind.poisson_ratio), {strain_smoothing, volume}});
  }
  if (kinds.size() > 1) result.elastic.of_tets = of_tets;
  for (Eigen::Index t = 0; t < volumes.size(); ++t) {
    const MaterialRegion& kind = kinds[static_cast<std::size_t>(of_tets[static_cast<std::size_t>(t)])];
    result.densities[t] = kind.density_kg_m3;
    result.mean_youngs_modulus_pa += kind.youngs_modulus_pa * volumes[t] / volumes.sum();
    result.largest_youngs_modulus_pa = std::max(result.largest_youngs_modulus_pa, kind.youngs_modulus_pa);
  }
  return result;
}

void requireUsedRegions(const TetTopology& topology, const Material& material) {
  const std::vector<int> kinds = kindsOf(topology, material.regions);
  for (std::size_t r = 0; r < material.regions.size(); ++r) {
    if (std::count(kinds.begin(), kinds.end(), static_cast<int>(r) + 1) > 0) continue;
    throw std::invalid_argument(fmt::format(
        "region {} of the material has no tet; the centre of a tet must lie in it, and in no later region",
        r + 1));
  }
}

}  // namespace softbody
