#pragma once

#include <memory>

namespace ros {
class NodeHandle;
}

namespace softbody {

/// Makes a node from its handle and its private handle.
using NodeMaker = std::shared_ptr<void> (*)(const ros::NodeHandle&, const ros::NodeHandle&);

/// What becomes of memory that a node has freed.
enum class FreedMemory {
  kForNextImage,  ///< it stays: otherwise the system has to clear the same pages for every frame
  kReturned,  ///< large arrays of a model that is replaced go back at once, and leave no holes in the heap
};

/// Each line of this process's log appears at once, in a pipe or a file, too. Otherwise lines below warnings
/// wait there until some kilobytes have come. Call it before anything is written.
void logLineByLine();

/// Runs a node as a process. @return the exit code: 1, with a log message, if it cannot start.
int runNode(int argc, char** argv, const char* name, NodeMaker make,
            FreedMemory freed = FreedMemory::kForNextImage);

}  // namespace softbody
