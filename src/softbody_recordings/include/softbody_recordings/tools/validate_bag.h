#pragma once

namespace softbody::validation {

/// The tool `validate_bag`: finds the faults of a recording. Exit code 1 if the recording is not usable.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runValidateBag(int argc, char** argv);

}  // namespace softbody::validation
