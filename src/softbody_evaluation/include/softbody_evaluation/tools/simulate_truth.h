#pragma once

namespace softbody::evaluation {

/// The tool `simulate_truth`: simulates the body with exact targets for all visible vertices.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runSimulateTruth(int argc, char** argv);

}  // namespace softbody::evaluation
