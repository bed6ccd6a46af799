#include "tools/vertex_region.h"

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
  static const std::regex kForm(
      R"(\s*([xyz])\s*(<=|>=|<|>)\s*([-+]?(?:[0-9]+[.]?[0-9]*|[.][0-9]+)(?:[eE][-+]?[0-9]+)?)\s*)");
  std::smatch match;
  if (!std::regex_match(text, match, kForm)) {
    throw std::invalid_argument(fmt::format(
        "'{}' is not a condition; allowed: x, y or z, then <, <=, > or >=, then a number [m]", text));
  }
  return {match[1].str()[0] - 'x', match[2].str(), std::stod(match[3].str())};
}

std::vector<Condition> parseRegion(const std::string& region) {
  std::vector<Condition> conditions;
  if (region == "all") return conditions;
  if (region.empty()) return {parseCondition(region)};
  std::stringstream parts(region);
  for (std::string part; std::getline(parts, part, '&');) conditions.push_back(parseCondition(part));
  return conditions;
}

}  // namespace

void requireRegion(const std::string& region) { parseRegion(region); }

std::vector<int> verticesWhere(const std::string& region, const Points& vertices) {
  const std::vector<Condition> conditions = parseRegion(region);
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
