#pragma once

namespace softbody {

/// Answers one FillRequest on stdin with the tets on stdout. The only function that uses TetGen.
/// @return the exit code of the process: 0 or 1. TetGen may also crash.
int answerFillRequest();

}  // namespace softbody
