#pragma once

#include <string>

namespace softbody {

/// Width of the vector instructions that the inner loops use.
enum class Simd { kAuto, kSse4, kAvx2, kAvx512 };

/// The widest one that this processor has, or the one asked for.
/// @throw std::invalid_argument if this processor does not have it.
Simd supportedSimd(Simd wanted);

/// "auto", "sse4", "avx2", "avx512"; and back. @throw std::invalid_argument for another name.
const char* nameOf(Simd simd);
Simd simdFromName(const std::string& name);

}  // namespace softbody
