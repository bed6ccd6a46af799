#include "softbody_sim/object/vertex_region.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace softbody {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Cuts the box to the half-space of a condition.
void limitTo(const std::string& condition, Eigen::AlignedBox3d* box) {
  static const std::regex kForm(
      R"(\s*([xyz])\s*(<=|>=|<|>)\s*([-+]?(?:[0-9]+[.]?[0-9]*|[.][0-9]+)(?:[eE][-+]?[0-9]+)?)\s*)");
  std::smatch match;
  if (!std::regex_match(condition, match, kForm)) {
    throw std::invalid_argument(fmt::format(
        "'{}' is not a condition; allowed: x, y or z, then <, <=, > or >=, then a number [m]", condition));
  }
  const int axis = match[1].str()[0] - 'x';
  const std::string relation = match[2];
  const double limit = std::stod(match[3]);
  const bool strict = relation.size() == 1;
  double &min = box->min()[axis], &max = box->max()[axis];
  if (relation[0] == '<')
    max = std::min(max, strict ? std::nextafter(limit, -kInfinity) : limit);
  else
    min = std::max(min, strict ? std::nextafter(limit, kInfinity) : limit);
}

}  // namespace

Eigen::AlignedBox3d boxOf(const std::string& region) {
  Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-kInfinity), Eigen::Vector3d::Constant(kInfinity));
  if (region == "all") return box;
  if (region.empty()) limitTo(region, &box);
  std::stringstream parts(region);
  for (std::string part; std::getline(parts, part, '&');) limitTo(part, &box);
  return box;
}

std::string nearestVertex(const Eigen::AlignedBox3d& box, const Points& vertices) {
  Eigen::Index nearest = 0;
  double distance = kInfinity;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const double outside = box.exteriorDistance(Eigen::Vector3d(vertices.row(v)));
    if (outside < distance) distance = outside, nearest = v;
  }
  return fmt::format("the nearest, {:.4g} mm outside at [{:.4g}, {:.4g}, {:.4g}] m, is vertex {}",
                     1e3 * distance, vertices(nearest, 0), vertices(nearest, 1), vertices(nearest, 2),
                     nearest);
}

std::vector<int> verticesWhere(const std::string& region, const Points& vertices) {
  const Eigen::AlignedBox3d box = boxOf(region);
  std::vector<int> chosen;
  for (int v = 0; v < vertices.rows(); ++v) {
    if (box.contains(Eigen::Vector3d(vertices.row(v)))) chosen.push_back(v);
  }
  if (chosen.empty() && vertices.rows() > 0) {
    throw std::invalid_argument(
        fmt::format("no vertex lies in the region '{}'; {}", region, nearestVertex(box, vertices)));
  }
  return chosen;
}

}  // namespace softbody
