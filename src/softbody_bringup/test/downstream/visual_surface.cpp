#include "softbody_sim/interpolation/visual_surface.h"

#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/object/object_model.h"

/// Bends the tets, lets the visual mesh follow them, and writes it to bent.obj.
int main(int, char** argv) {
  const softbody::ObjectModel model = softbody::buildObjectModel(softbody::loadObjectDescription(argv[1]));
  const softbody::VisualSurface surface(model.visual, model.volume);
  softbody::MeshState volume;
  volume.vertices = model.volume.rest_vertices;
  volume.vertices.col(2) += 4.0 * volume.vertices.col(0).cwiseAbs2();
  volume.confidence.assign(volume.vertices.rows(), 1.0f);
  const softbody::MeshState bent = surface.apply(volume);
  softbody::writeObj("bent.obj", {bent.vertices, model.visual.triangles});
  return bent.vertices.rows() == model.visual.rest_vertices.rows() ? 0 : 1;
}
