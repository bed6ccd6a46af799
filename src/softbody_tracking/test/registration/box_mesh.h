#pragma once

#include "fixtures/synthetic_scene.h"

namespace softbody {

inline const BoxBody kBox = makeBox();
inline const TriangleMesh kMesh{kBox.surface.rest_vertices, kBox.surface.triangles};

}  // namespace softbody
