#include "softbody_sim/surface_mesh/closest_point.h"

#include <iostream>

#include "softbody_sim/object/object_model.h"

/// Prints the point of an object that is closest to a point.
int main(int, char** argv) {
  const softbody::ObjectModel model = softbody::buildObjectModel(softbody::loadObjectDescription(argv[1]));
  const softbody::ClosestPointQuery query(model.visual.rest_vertices, model.visual.triangles);
  const softbody::SurfacePoint closest = query.closest({0.0, 0.0, 0.3});
  std::cout << closest.position.transpose() << " in triangle " << closest.triangle << '\n';
  return closest.triangle >= 0 ? 0 : 1;
}
