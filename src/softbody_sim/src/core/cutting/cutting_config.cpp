#include "softbody_sim/cutting/cutting_config.h"

namespace softbody {

CuttingConfig readCuttingConfig(Parameters& parameters) {
  CuttingConfig config;
  config.min_advance_m = parameters.number("min_advance_m", config.min_advance_m, 1e-4, 0.1);
  config.slit_tolerance_m = parameters.number("slit_tolerance_m", config.slit_tolerance_m, 0.0, 0.1);
  config.max_gap_s = parameters.number("max_gap_s", config.max_gap_s, 0.0, 60.0);
  config.tear_strain = parameters.number("tear_strain", config.tear_strain, 0.0, 100.0);
  config.max_pieces = parameters.integer("max_pieces", config.max_pieces, 1, 100000);
  config.undo_memory_mb = parameters.number("undo_memory_mb", config.undo_memory_mb, 0.0, 1e5);
  return config;
}

}  // namespace softbody
