#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_evaluation/records/material_map.h"

namespace softbody::evaluation {

/// A deforming surface, as a bag holds it.
struct SurfaceRecord {
  std::string frame_id;                              ///< of the states
  std::map<std::uint32_t, MeshTopology> topologies;  ///< by revision
  std::map<Nanoseconds, MeshState> states;           ///< by stamp
  std::vector<MaterialMap> material;                 ///< by stamp; before the first and if empty: the truth's
  std::vector<std::string> notes;                    ///< what was left out, in sentences
};

/// The topology of one of the record's states.
inline const MeshTopology& topologyOf(const SurfaceRecord& record, const MeshState& state) {
  return record.topologies.at(state.revision);
}

/// The material of the record's state of a stamp.
inline const MaterialMap& materialAt(const SurfaceRecord& record, Nanoseconds stamp) {
  static const MaterialMap same;
  const MaterialMap* last = &same;
  for (const MaterialMap& map : record.material) {
    if (map.first <= stamp) last = &map;
  }
  return *last;
}

}  // namespace softbody::evaluation
