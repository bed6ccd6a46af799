#pragma once

#include "softbody_common/parameters/parameter_table.h"

namespace softbody {

/// When a moving blade cuts, when stretched material tears, and the bounds of a cut body.
struct CuttingConfig {
  double min_advance_m = 0.005;     ///< the blade cuts when its edge is this far beyond the front of the cut
  double slit_tolerance_m = 0.005;  ///< a blade this close to an earlier cut is in its slit
  double max_gap_s = 0.5;           ///< a blade without a pose for longer than this has been lifted
  double tear_strain = 0.0;      ///< the body tears above this strain (1.0: twice the rest length); 0: never
  int max_pieces = 500;          ///< a cut that would leave more is refused
  double undo_memory_mb = 60.0;  ///< for undo and redo; strokes beyond are cut again when they are undone
};

const ParameterTable<CuttingConfig>& cuttingParameters();

}  // namespace softbody
