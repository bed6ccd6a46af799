#pragma once

namespace softbody::injection {

/// The tool `inject`: copies a bag and adds faults to its images.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runInject(int argc, char** argv);

}  // namespace softbody::injection
