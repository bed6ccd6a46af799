#pragma once

namespace softbody::evaluation {

/// The tool `draw_cut`: draws pictures of cut bodies, without a display.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runDrawCut(int argc, char** argv);

}  // namespace softbody::evaluation
