#pragma once

namespace softbody {

/// The tool `replay`: runs the core code of the graph on a bag, without a ROS master.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runReplay(int argc, char** argv);

}  // namespace softbody
