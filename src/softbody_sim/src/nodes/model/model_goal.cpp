#include "nodes/model/model_goal.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace softbody {
namespace {

constexpr double kLargest = 1e6;  // far above every measure of a body, in any unit

void requireAbsolute(const char* field, const std::string& path) {
  if (std::filesystem::path(path).is_absolute()) return;
  throw std::invalid_argument(fmt::format("{} is '{}'; allowed: an absolute path", field, path));
}

double measure(const char* field, double value) {
  if (value >= 0.0 && value <= kLargest) return value;
  throw std::invalid_argument(
      fmt::format("{} is {}; allowed: 0 (not given) or a number above 0", field, value));
}

bool isAllowed(std::int64_t value, const AllowedCount& allowed) {
  return value >= allowed.least && value <= allowed.most;
}

int count(const char* field, std::uint32_t value, const AllowedCount& allowed) {
  if (value == 0 || isAllowed(value, allowed)) return static_cast<int>(value);
  throw std::invalid_argument(
      fmt::format("{} is {}; allowed: 0 (not given) or {} to {}", field, value, allowed.least, allowed.most));
}

void requireShell(const std::string& shell) {
  if (shell.empty() || shell == "largest" || shell == "all") return;
  const bool is_number = shell.find_first_not_of("0123456789") == std::string::npos;
  if (is_number && isAllowed(std::strtol(shell.c_str(), nullptr, 10), kShellNumbers)) return;
  throw std::invalid_argument(fmt::format("shell is '{}'; allowed: largest, all, or a number from {} to {}",
                                          shell, kShellNumbers.least, kShellNumbers.most));
}

void requireOneSize(const softbody_msgs::PrepareModelGoal& goal) {
  const int given = (goal.unit.empty() ? 0 : 1) + (goal.length > 0.0 ? 1 : 0) + (goal.scale > 0.0 ? 1 : 0);
  if (given > 1) throw std::invalid_argument("give only one of unit, length and scale");
}

}  // namespace

ModelSource sourceOf(const softbody_msgs::PrepareModelGoal& goal) {
  requireAbsolute("mesh", goal.mesh);
  requireAbsolute("output", goal.output);
  requireOneSize(goal);
  requireShell(goal.shell);
  ModelSource source;
  source.mesh = goal.mesh;
  if (!goal.unit.empty()) source.unit = goal.unit;
  source.scale = measure("scale", goal.scale);
  source.body.length_m = measure("length", goal.length);
  source.body.thickness = measure("thickness", goal.thickness);
  source.body.shell = goal.shell;
  source.body.triangles = count("triangles", goal.triangles, kTriangleCounts);
  return source;
}

VolumeSettings settingsOf(const softbody_msgs::PrepareModelGoal& goal) {
  VolumeSettings settings;
  settings.cage_vertices = count("cage_vertices", goal.cage_vertices, kCageVertexCounts);
  settings.use_cache = false;
  return settings;
}

}  // namespace softbody
