#pragma once

#include <functional>
#include <string>

#include "softbody_common/files/input_file.h"

namespace softbody::evaluation {

struct TruthSimulationOptions {
  std::string truth;   ///< bag with /ground_truth/surface/...
  std::string object;  ///< object YAML
  std::string output;  ///< bag to write: /softbody/surface/topology and /softbody/surface/state
  FileScope scope = FileScope::kOwnFolder;  ///< of the files that the object YAML names
};

/// Simulates the body with exact targets for all vertices that the truth's camera sees, and no other targets.
/// The error of the output is the error that remains with a perfect tracker.
/// @param progress called with the finished share, 0..1.
/// @throw std::invalid_argument if a file cannot be used, the object is not the truth's, or the truth is cut.
void simulateTruth(const TruthSimulationOptions& options, const std::function<void(double)>& progress);

}  // namespace softbody::evaluation
