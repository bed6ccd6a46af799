#include "simd/simd.h"

#include <fmt/format.h>
#include <hwy/highway.h>

#include <stdexcept>

namespace softbody {
namespace {

bool supported(Simd simd) {
  const auto targets = hwy::SupportedTargets();
  if (simd == Simd::kSse4) return (targets & HWY_SSE4) != 0;
  if (simd == Simd::kAvx2) return (targets & HWY_AVX2) != 0;
  return (targets & HWY_AVX3) != 0;
}

}  // namespace

Simd supportedSimd(Simd wanted) {
  if (wanted == Simd::kAuto) {
    for (Simd simd : {Simd::kAvx512, Simd::kAvx2, Simd::kSse4}) {
      if (supported(simd)) return simd;
    }
    return Simd::kAuto;
  }
  if (!supported(wanted))
    throw std::invalid_argument(fmt::format("this processor does not support {}", nameOf(wanted)));
  return wanted;
}

const char* nameOf(Simd simd) {
  static constexpr const char* kNames[] = {"auto", "sse4", "avx2", "avx512"};
  return kNames[static_cast<int>(simd)];
}

Simd simdFromName(const std::string& name) {
  for (Simd simd : {Simd::kAuto, Simd::kSse4, Simd::kAvx2, Simd::kAvx512}) {
    if (name == nameOf(simd)) return simd;
  }
  throw std::invalid_argument(fmt::format("simd is '{}'; allowed: auto, sse4, avx2, avx512", name));
}

}  // namespace softbody
