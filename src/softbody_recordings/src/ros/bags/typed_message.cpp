#include "softbody_recordings/ros/typed_message.h"

#include <fmt/format.h>

namespace softbody {

std::string typeFault(const std::string& type, const std::string& md5sum, const MessageType& expected) {
  if (type != expected.name) return fmt::format("is of type {} instead of {}", type, expected.name);
  if (md5sum == expected.md5sum) return "";
  return fmt::format(
      "has another definition of {}: its md5sum is {} in the bag, and {} here; convert the bag with rosbag "
      "fix, or "
      "record or replay it again with this version",
      type, md5sum, expected.md5sum);
}

}  // namespace softbody
