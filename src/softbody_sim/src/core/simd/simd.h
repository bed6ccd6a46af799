#pragma once

#include <string>

namespace softbody {

/// Vector instructions of the kernels.
enum class Simd { kAuto, kSse4, kAvx2, kAvx512 };

/// The given instructions; for kAuto the widest that this processor has.
/// @throw std::invalid_argument if this processor does not have them.
Simd supportedSimd(Simd wanted);

/// "auto", "sse4", "avx2" or "avx512". @throw std::invalid_argument for another name.
const char* nameOf(Simd simd);
Simd simdFromName(const std::string& name);

}  // namespace softbody
