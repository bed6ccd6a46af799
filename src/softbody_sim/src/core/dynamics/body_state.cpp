#include "dynamics/body_state.h"

#include <utility>

#include "softbody_common/rigid_fit.h"
#include "softbody_common/tet_locator.h"

namespace softbody {

void placeAtRest(const Points& rest_vertices, const Eigen::Isometry3d& pose, Nanoseconds stamp,
                 BodyState* body) {
  body->mesh.vertices = transformed(rest_vertices, pose);
  body->velocity = body->loads = Points::Zero(rest_vertices.rows(), 3);
  body->stamp = stamp;
  body->placed = true;
  body->obstacle_poses.clear();  // the obstacles did not move from their earlier poses to these
}

void transferToEdit(const TetEdit& edit, const Tets& tets, BodyState* body) {
  std::vector<float> confidence;
  for (const MaterialPoint& origin : edit.vertex_origins) {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k)
      sum += origin.barycentric[k] * body->mesh.confidence[static_cast<std::size_t>(tets(origin.tet, k))];
    confidence.push_back(static_cast<float>(sum));
  }
  body->mesh.confidence = std::move(confidence);
  body->mesh.vertices = applyBinding(edit.vertex_origins, body->mesh.vertices, tets);
  body->velocity = applyBinding(edit.vertex_origins, body->velocity, tets);
  body->loads = applyBinding(edit.vertex_origins, body->loads, tets);
}

}  // namespace softbody
