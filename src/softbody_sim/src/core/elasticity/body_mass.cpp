#include "softbody_sim/elasticity/body_mass.h"

#include "elasticity/tet_materials.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

double bodyMass(const TetTopology& topology, const Material& material) {
  return tetMaterials(topology, material, 0.0, {})
      .densities.dot(tetVolumes(topology.rest_vertices, topology.tets));
}

}  // namespace softbody
