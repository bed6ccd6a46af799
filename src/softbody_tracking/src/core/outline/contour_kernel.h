#pragma once

#include <cstddef>
#include <vector>

namespace softbody {

/// Weighted sums of distances.
struct DistanceSums {
  double weights = 0.0, first = 0.0, second = 0.0;
};

/// Candidates of an end, in the order of the line. Whole vectors of them are read, so the arrays are longer.
struct EndCandidates {
  static constexpr std::size_t kWidest = 8;  ///< doubles in the widest vector

  std::vector<double> distances;  ///< [px]
  std::vector<double> log_odds;   ///< logarithms of their likelihood, up to a constant
  std::size_t count = 0;          ///< that are candidates

  void resize(std::size_t size) {
    count = size;
    distances.resize(size + kWidest);
    log_odds.resize(size + kWidest);
  }
};

/// Sums over candidates, weighted by likelihood, by the prediction, and by both.
struct EndSums {
  DistanceSums alone, predicted, together;
};

/// @param largest of the log odds. @param precision inverse of the prediction's variance [1/px^2].
EndSums sumEnds(const EndCandidates& ends, double largest, double precision);

}  // namespace softbody
