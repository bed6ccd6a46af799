#pragma once

#include <cstdint>

namespace softbody {

/// A 64-bit hash (Steele, Lea, Flood 2014, SplitMix64). Unlike the standard library, it gives the same value
/// on every machine.
inline std::uint64_t hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

inline std::uint64_t hash(std::uint64_t a, std::uint64_t b) { return hash(hash(a) ^ b); }

/// Uniform in [0, 1) from a hash.
inline double unit(std::uint64_t h) { return static_cast<double>(h >> 11) * 0x1.0p-53; }

}  // namespace softbody
