#pragma once

#include <hwy/highway.h>

#include "simd/simd.h"

namespace softbody {

/// Index of a width's function in Highway's tables (HWY_DISPATCH_TABLE). HWY_DYNAMIC_DISPATCH would choose
/// once for the process. This function chooses for each object. Call it from the file that fills the table.
inline std::size_t dispatchIndex(Simd simd) {
  hwy::ChosenTarget chosen;
  switch (supportedSimd(simd)) {
    case Simd::kAvx512:
      chosen.Update(HWY_AVX3);
      break;
    case Simd::kAvx2:
      chosen.Update(HWY_AVX2);
      break;
    case Simd::kSse4:
      chosen.Update(HWY_SSE4);
      break;
    case Simd::kAuto:
      chosen.Update(HWY_EMU128);
      break;
  }
  return chosen.GetIndex();
}

}  // namespace softbody
