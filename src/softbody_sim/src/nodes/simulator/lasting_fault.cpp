#include "nodes/simulator/lasting_fault.h"

#include <ros/console.h>

namespace softbody {

void LastingFault::begin(const std::string& sentence) {
  if (sentence_.empty()) ROS_WARN_STREAM(sentence);
  sentence_ = sentence;
}

void LastingFault::end(const std::string& line) {
  if (!sentence_.empty()) ROS_INFO_STREAM(line);
  sentence_.clear();
}

}  // namespace softbody
