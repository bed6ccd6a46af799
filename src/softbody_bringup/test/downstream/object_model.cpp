#include "softbody_sim/object/object_model.h"

#include <iostream>

/// Loads an object. If its YAML names no tets, they are made.
int main(int, char** argv) {
  const softbody::ObjectModel model = softbody::buildObjectModel(softbody::loadObjectDescription(argv[1]));
  std::cout << model.visual.rest_vertices.rows() << " vertices, " << model.volume.tets.rows() << " tets, E "
            << model.material.youngs_modulus_pa << " Pa\n";
  return model.warnings.empty() ? 0 : 1;
}
