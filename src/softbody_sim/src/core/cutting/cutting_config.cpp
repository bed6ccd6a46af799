#include "softbody_sim/cutting/cutting_config.h"

namespace softbody {
namespace {

ParameterTable<CuttingConfig> makeCuttingTable() {
  ParameterTable<CuttingConfig> table;
  table.group("cutting");
  table.number(
      "min_advance_m", &CuttingConfig::min_advance_m, {1e-4, 0.1}, "m",
      "the blade cuts when its edge is this far beyond the front; less for a blade with an exact pose");
  table.number(
      "slit_tolerance_m", &CuttingConfig::slit_tolerance_m, {0.0, 0.1}, "m",
      "a blade within this distance of an earlier cut is in its slit; more for a blade with a noisy pose");
  table.number("tear_strain", &CuttingConfig::tear_strain, {0.0, 100.0}, "share",
               "stretch at which the material tears; 0: never");
  table.number("max_pieces", &CuttingConfig::max_pieces, {1, 100000}, "",
               "a cut that would leave more pieces is refused: each one takes time in every frame");
  return table;
}

}  // namespace

const ParameterTable<CuttingConfig>& cuttingParameters() {
  static const ParameterTable<CuttingConfig> table = makeCuttingTable();
  return table;
}

}  // namespace softbody
