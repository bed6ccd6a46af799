#pragma once

#include <functional>
#include <random>
#include <string>
#include <vector>

#include "recordings/recording.h"

namespace softbody::recordings {

using Random = std::mt19937;
using Change = std::function<void(Recording*, Random*)>;

/// A change of a recording, as other cameras, drivers and tools write them.
struct Mutation {
  enum Part {
    kColorPixels = 1,
    kDepthPixels = 2,
    kInfo = 4,
    kTopics = 8,
    kStamps = 16,
    kFrames = 32,
    kFile = 64
  };
  std::string name;
  bool works = true;  ///< whether the recording can still be tracked
  int parts = 0;      ///< what it changes: one recording gets at most one mutation of a part
  Change apply;
  bool lossy = false;  ///< it takes depth away, so that a recording that works is tracked less exactly
};

/// Pixels, encodings and transports.
std::vector<Mutation> cameraMutations();
/// CameraInfo, lenses, and depth of its own camera.
std::vector<Mutation> lensMutations();
/// Topics, stamps, frames and files.
std::vector<Mutation> deliveryMutations();

}  // namespace softbody::recordings
