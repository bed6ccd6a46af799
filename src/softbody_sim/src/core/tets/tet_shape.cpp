#include "tets/tet_shape.h"

#include <fmt/format.h>

#include <stdexcept>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

Eigen::VectorXd positiveVolumes(const Points& rest_vertices, const Tets& tets) {
  Eigen::VectorXd volumes = tetVolumes(rest_vertices, tets);
  for (Eigen::Index t = 0; t < volumes.size(); ++t) {
    if (!(volumes[t] > 0.0))
      throw std::invalid_argument(fmt::format("tet {} has volume {} m^3", t, volumes[t]));
  }
  return volumes;
}

}  // namespace softbody
