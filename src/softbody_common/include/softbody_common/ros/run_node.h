#pragma once

#include <memory>

namespace ros {
class NodeHandle;
}

namespace softbody {

/// Makes a node from its handle and its private handle.
using NodeMaker = std::shared_ptr<void> (*)(const ros::NodeHandle&, const ros::NodeHandle&);

/// Each line of this process's log appears at once, in a pipe or a file, too. Otherwise lines below warnings
/// wait there until some kilobytes have come. Call it before anything is written.
void logLineByLine();

/// Runs a node as a process. @return the exit code: 1, with a log message, if it cannot start.
int runNode(int argc, char** argv, const char* name, NodeMaker make);

}  // namespace softbody
