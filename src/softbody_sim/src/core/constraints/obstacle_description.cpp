#include "softbody_sim/constraints/obstacle_description.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace softbody {
namespace {

constexpr double kLargestSize = 10.0;      // [m]
constexpr std::size_t kLongestName = 100;  // of what has a topic

Obstacle readShape(Parameters& parameters, const std::string& name) {
  const std::string shape = parameters.choice("shape", "sphere", {"plane", "sphere", "capsule", "box"});
  const auto size = [&](const char* key, double min) {
    return parameters.number(key, 0.01, min, kLargestSize);
  };
  if (shape == "plane") return Obstacle::plane();
  if (shape == "sphere") return Obstacle::sphere(size("radius_m", 1e-4));
  if (shape == "capsule") {
    const double radius = size("radius_m", 1e-4);
    return Obstacle::capsule(radius, parameters.number("length_m", 0.1, 0.0, kLargestSize));
  }
  const std::vector<double> sizes = parameters.numbers("size_m", {0.1, 0.1, 0.1});
  const auto [smallest, largest] = std::minmax_element(sizes.begin(), sizes.end());
  if (!(*smallest > 0.0 && *largest <= kLargestSize)) {
    throw std::invalid_argument(fmt::format("obstacle '{}': size_m is [{}]; allowed: above 0, up to {}", name,
                                            fmt::join(sizes, ", "), kLargestSize));
  }
  return Obstacle::box(Eigen::Vector3d(sizes.data()),
                       parameters.number("rounding_m", 0.0, 0.0, 0.5 * *smallest));
}

Eigen::Isometry3d readPose(Parameters& parameters, const std::string& name) {
  const std::vector<double> p = parameters.numbers("pose", {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0});
  const Eigen::Quaterniond rotation(p[6], p[3], p[4], p[5]);
  if (!(std::abs(rotation.norm() - 1.0) <= 0.01)) {
    throw std::invalid_argument(fmt::format(
        "obstacle '{}': the quaternion of its pose (last four numbers: x y z w) has length {:.4g}; "
        "allowed: 0.99 to 1.01",
        name, rotation.norm()));
  }
  return Eigen::Translation3d(p[0], p[1], p[2]) * rotation.normalized();
}

}  // namespace

void requireTopicName(const std::string& name) {
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const bool usable = !name.empty() && name.size() <= kLongestName && isLetter(name.front()) &&
                      std::all_of(name.begin(), name.end(),
                                  [&](char c) { return isLetter(c) || (c >= '0' && c <= '9') || c == '_'; });
  if (usable) return;
  throw std::invalid_argument(
      fmt::format("name is '{}'; allowed: up to {} letters, digits and _, starting with a letter",
                  name.substr(0, kLongestName), kLongestName));
}

ObstacleDescription readObstacle(Parameters& map) {
  ObstacleDescription obstacle;
  obstacle.name = map.requiredText("name");
  requireTopicName(obstacle.name);
  obstacle.frame = map.text("frame", "");
  obstacle.shape = readShape(map, obstacle.name);
  obstacle.shape.friction = map.number("friction", 0.0, 0.0, 10.0);
  obstacle.shape.pose = readPose(map, obstacle.name);
  return obstacle;
}

std::vector<ObstacleDescription> readObstacles(Parameters& parameters, std::vector<std::string>* unknown) {
  std::vector<ObstacleDescription> obstacles;
  for (Parameters& map : parameters.maps("obstacles")) {
    ObstacleDescription obstacle = readObstacle(map);
    const bool taken = std::any_of(obstacles.begin(), obstacles.end(), [&](const ObstacleDescription& other) {
      return other.name == obstacle.name;
    });
    if (taken) throw std::invalid_argument(fmt::format("two obstacles are named '{}'", obstacle.name));
    for (const std::string& key : map.unknown()) unknown->push_back(key);
    obstacles.push_back(std::move(obstacle));
  }
  return obstacles;
}

}  // namespace softbody
