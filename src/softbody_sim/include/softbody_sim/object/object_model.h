#pragma once

#include <functional>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/io/warnings.h"
#include "softbody_sim/object/material.h"
#include "softbody_sim/object/object_description.h"

namespace softbody {

/// How a volume is made if the object has no tet mesh.
struct VolumeSettings {
  int cage_vertices = 0;  ///< approximate number of vertices of the low-resolution surface; 0: automatic
  bool use_cache = true;  ///< $XDG_CACHE_HOME/softbody or ~/.cache/softbody, by content
  std::function<void(double)> progress = [](double) {};  ///< called with the finished fraction, 0..1
};

/// The meshes and the material of one object.
struct ObjectModel {
  MeshTopology visual;  ///< revision 0
  TetTopology volume;   ///< revision 0, its surface is the low-resolution surface
  Material material;
  Warnings warnings;  ///< repairs, vertices outside of the tets; also the description's warnings
};

/// Loads the meshes that the description names, welds and repairs them, and makes the missing ones (cage,
/// tets). A missing mesh comes from the cache if the cache has one for the same content. A new volume equals
/// the cached one bit for bit.
/// @throw std::invalid_argument with the file and the place in it.
ObjectModel buildObjectModel(const ObjectDescription& description, const VolumeSettings& settings = {});

}  // namespace softbody
