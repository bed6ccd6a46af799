#pragma once

namespace softbody::injection {

/// The tool `inject`: a copy of a bag with faults in the images.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runInject(int argc, char** argv);

}  // namespace softbody::injection
