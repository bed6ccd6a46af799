#pragma once

#include <cstddef>

namespace softbody::bench {

/// Bandwidth of STREAM's triad, a = b + s c (McCalpin 1995), in float on one thread [bytes/s]. @param bytes
/// of the three arrays together.
double triadBandwidth(std::size_t bytes);

/// Bandwidth of reading an array of floats again and again on one thread [bytes/s].
double readBandwidth(std::size_t bytes);

/// Operations of one thread in float, with the widest vectors of this processor [1/s]. A multiply-add counts
/// as two.
double peakOperations();

}  // namespace softbody::bench
