#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "softbody_common/types.h"

namespace softbody::evaluation {

/// A deforming surface, as a bag holds it.
struct SurfaceRecord {
  std::string frame_id;                              ///< of the states
  std::map<std::uint32_t, MeshTopology> topologies;  ///< by revision
  std::map<Nanoseconds, MeshState> states;           ///< by stamp
  std::vector<std::string> notes;                    ///< what was left out, in sentences
};

/// The topology of one of the record's states.
inline const MeshTopology& topologyOf(const SurfaceRecord& record, const MeshState& state) {
  return record.topologies.at(state.revision);
}

}  // namespace softbody::evaluation
