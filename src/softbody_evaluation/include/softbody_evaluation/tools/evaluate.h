#pragma once

namespace softbody::evaluation {

/// The tool `evaluate`: measures the accuracy of a result; prints a verdict and a table, or JSON.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runEvaluate(int argc, char** argv);

}  // namespace softbody::evaluation
