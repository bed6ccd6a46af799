#include "core/vertex_region.h"

#include <fmt/format.h>

#include <regex>
#include <sstream>
#include <stdexcept>

namespace softbody {
namespace {

struct Condition {
  int axis = 0;
  std::string relation;
  double limit = 0.0;

  bool isMetBy(double value) const {
    if (relation == "<") return value < limit;
    if (relation == "<=") return value <= limit;
    if (relation == ">") return value > limit;
    return value >= limit;
  }
};

Condition parseCondition(const std::string& text) {
  static const std::regex kForm(R"(\s*([xyz])\s*(<=|>=|<|>)\s*([-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?)\s*)");
  std::smatch match;
  if (!std::regex_match(text, match, kForm)) {
    throw std::invalid_argument(fmt::format(
        "'{}' is no condition; allowed: x, y or z, then <, <=, > or >=, then a number [m]", text));
  }
  return {match[1].str()[0] - 'x', match[2].str(), std::stod(match[3].str())};
}

}  // namespace

std::vector<int> verticesWhere(const std::string& region, const Points& vertices) {
  std::vector<Condition> conditions;
  std::stringstream parts(region);
  for (std::string part; region != "all" && std::getline(parts, part, '&');)
    conditions.push_back(parseCondition(part));
  if (region.empty()) parseCondition(region);
  std::vector<int> chosen;
  for (int v = 0; v < vertices.rows(); ++v) {
    bool met = true;
    for (const Condition& condition : conditions) met = met && condition.isMetBy(vertices(v, condition.axis));
    if (met) chosen.push_back(v);
  }
  if (chosen.empty()) throw std::invalid_argument(fmt::format("no vertex lies in the region '{}'", region));
  return chosen;
}

}  // namespace softbody
