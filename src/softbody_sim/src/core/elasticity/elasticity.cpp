#include "softbody_sim/elasticity/elasticity.h"

#include <algorithm>
#include <stdexcept>

namespace softbody {

const std::vector<std::string>& elasticityNames() {
  static const std::vector<std::string> names{"corotated", "neo_hookean", "springs"};
  return names;
}

const std::string& nameOf(Elasticity elasticity) {
  return elasticityNames()[static_cast<std::size_t>(elasticity)];
}

Elasticity elasticityFromName(const std::string& name) {
  const auto& names = elasticityNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw std::invalid_argument("there is no elasticity '" + name + "'");
  return static_cast<Elasticity>(found - names.begin());
}

}  // namespace softbody
