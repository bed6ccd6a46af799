#include "softbody_common/ros/frame_name.h"

#include <fmt/format.h>
#include <ros/console.h>
#include <ros/names.h>

#include <mutex>
#include <set>

namespace softbody {
namespace {

constexpr std::size_t kMostWarnings = 100;  // any sender can make up names

bool isNew(const std::string& frame) {
  static std::mutex mutex;  // of nodelets in one process
  static std::set<std::string> known;
  const std::lock_guard lock(mutex);
  return known.size() < kMostWarnings && known.insert(frame).second;
}

}  // namespace

std::string frameName(const std::string& frame, const std::string& owner) {
  const std::string name = withoutSlash(frame);
  if (name != frame && isNew(frame))
    ROS_WARN_STREAM(fmt::format(
        "{}: the frame is '{}', but frames of tf2 have no leading slash: '{}' is used", owner, frame, name));
  return name;
}

std::string ownFrame(const std::string& frame, const char* key, const ros::NodeHandle& private_handle,
                     const std::string& name) {
  const std::string name_space = ros::names::parentNamespace(private_handle.getNamespace());
  return frameName(frame.empty() ? frameInNamespace(name_space, name) : frame,
                   fmt::format("parameter {}", key));
}

std::string ownFrameText(const std::string& name) {
  return fmt::format("{0} ([in other namespaces](../reference.md#frames): NAMESPACE/{0})", name);
}

}  // namespace softbody
