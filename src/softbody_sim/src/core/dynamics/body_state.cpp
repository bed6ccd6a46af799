#include "dynamics/body_state.h"

#include <utility>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_locator.h"

namespace softbody {
namespace {

/// Values of the edited volume's vertices. @param values of the vertices before; may be empty.
std::vector<float> transferred(const std::vector<MaterialPoint>& origins, const Tets& tets,
                               const std::vector<float>& values) {
  std::vector<float> result;
  if (values.empty()) return result;
  result.reserve(origins.size());
  for (const MaterialPoint& origin : origins) {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k)
      sum += origin.barycentric[k] * values[static_cast<std::size_t>(tets(origin.tet, k))];
    result.push_back(static_cast<float>(sum));
  }
  return result;
}

}  // namespace

void placeAtRest(const Points& rest_vertices, const Eigen::Isometry3d& pose, Nanoseconds stamp,
                 BodyState* body) {
  body->mesh.vertices = transformed(rest_vertices, pose);
  body->velocity = Points::Zero(rest_vertices.rows(), 3);
  body->loads = {body->velocity};
  body->memory = {};
  body->stamp = stamp;
  body->placed = true;
  body->contact = {};  // the obstacles did not move from their earlier poses to these
}

void transferToEdit(const TetEdit& edit, const Tets& tets, BodyState* body) {
  MeshState& mesh = body->mesh;
  body->contact.contacts.clear();  // they name points of the surface before
  body->memory = {};
  mesh.confidence = transferred(edit.vertex_origins, tets, mesh.confidence);
  mesh.standard_deviation = transferred(edit.vertex_origins, tets, mesh.standard_deviation);
  body->mesh.vertices = applyBinding(edit.vertex_origins, body->mesh.vertices, tets);
  body->velocity = applyBinding(edit.vertex_origins, body->velocity, tets);
  body->loads = {applyBinding(edit.vertex_origins, body->loads.per_mass, tets), {}, true};
}

}  // namespace softbody
