#pragma once

#include <functional>
#include <string>

namespace softbody {

struct TruthSimulationOptions {
  std::string truth;   ///< bag with /ground_truth/surface/...
  std::string object;  ///< object YAML
  std::string output;  ///< bag to write: /softbody/surface/topology and /softbody/surface/state
};

/// What the simulation makes of a scene when every vertex that is seen is known exactly, and nothing of the
/// others: the error that a tracker of this body is left with however well it sees.
/// @throw std::invalid_argument if a file cannot be used, the object is not the truth's, or the truth is cut.
void simulateTruth(const TruthSimulationOptions& options, const std::function<void(double)>& progress);

}  // namespace softbody
