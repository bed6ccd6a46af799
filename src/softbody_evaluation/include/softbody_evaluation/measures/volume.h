#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody::evaluation {

/// Whether every edge is used equally often in both directions. Vertices at the same position count as one.
bool isClosed(const Points& vertices, const Triangles& triangles);

/// The mean, and the value of largest magnitude with its sign.
struct Change {
  double mean = 0.0, largest = 0.0;
};

struct VolumeReport {
  bool closed = false;          ///< at every revision; if false, all values below are unknown
  double rest_m3 = 0.0;         ///< of the lowest revision
  Change change;                ///< of the frames, relative to rest_m3
  double cut_change = 0.0;      ///< of all pieces at rest, relative to rest_m3; the largest of the revisions
  std::optional<Change> error;  ///< relative to the truth's volume of the same frame
  std::vector<double> volumes;  ///< per frame [m3]
};

/// @param topologies by revision. @param states in time order, each of one of these revisions.
VolumeReport volumeDrift(const std::map<std::uint32_t, MeshTopology>& topologies,
                         const std::vector<const MeshState*>& states);

/// @param values not empty.
Change changeOf(const std::vector<double>& values);

}  // namespace softbody::evaluation
