#pragma once

namespace softbody {

/// The tool `check_tool`: checks whether a tool YAML fits a recording of the tool. Exit code 1 if it does
/// not.
/// @return the exit code: 0 done, 1 the data cannot be processed, 2 wrong usage.
int runCheckTool(int argc, char** argv);

}  // namespace softbody
