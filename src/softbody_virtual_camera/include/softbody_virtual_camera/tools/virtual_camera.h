#pragma once

namespace softbody::virtual_camera {

/// The tool `virtual_camera`: a virtual RGB-D camera that writes a bag or publishes as a live node.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runVirtualCamera(int argc, char** argv);

}  // namespace softbody::virtual_camera
