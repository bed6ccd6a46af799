#include "outline/contour_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "outline/contour_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Doubles = hn::CappedTag<double, EndCandidates::kWidest>;
using Vector = hn::Vec<Doubles>;

/// Of vectors of candidates.
class Sums {
 public:
  HWY_INLINE Sums()
      : weights_(hn::Zero(Doubles())), first_(hn::Zero(Doubles())), second_(hn::Zero(Doubles())) {}

  HWY_INLINE void add(Vector weight, Vector distance) {
    const Vector moment = hn::Mul(weight, distance);
    weights_ = hn::Add(weights_, weight);
    first_ = hn::Add(first_, moment);
    second_ = hn::MulAdd(moment, distance, second_);
  }
  HWY_INLINE DistanceSums total() const {
    const Doubles d;
    return {hn::GetLane(hn::SumOfLanes(d, weights_)), hn::GetLane(hn::SumOfLanes(d, first_)),
            hn::GetLane(hn::SumOfLanes(d, second_))};
  }

 private:
  Vector weights_, first_, second_;
};

/// @param count of candidates; both arrays are padded to whole vectors.
EndSums sum(const double* distances, const double* log_odds, std::size_t count, double largest,
            double precision) {
  const Doubles d;
  const Vector top = hn::Set(d, largest), half = hn::Set(d, -0.5 * precision);
  Sums alone, predicted, together;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    const auto counts = hn::FirstN(d, count - i);
    const Vector distance = hn::LoadU(d, distances + i);
    const Vector likelihood =
        hn::IfThenElseZero(counts, hn::Exp(d, hn::Sub(hn::LoadU(d, log_odds + i), top)));
    const Vector prior = hn::IfThenElseZero(counts, hn::Exp(d, hn::Mul(half, hn::Mul(distance, distance))));
    alone.add(likelihood, distance);
    predicted.add(prior, distance);
    together.add(hn::Mul(likelihood, prior), distance);
  }
  return {alone.total(), predicted.total(), together.total()};
}

}  // namespace

// Functions of the table have external linkage.
EndSums sumDoubles(const double* distances, const double* log_odds, std::size_t count, double largest,
                   double precision) {
  return sum(distances, log_odds, count, largest, precision);
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {

HWY_EXPORT(sumDoubles);

EndSums sumEnds(const EndCandidates& ends, double largest, double precision) {
  return HWY_DYNAMIC_DISPATCH(sumDoubles)(ends.distances.data(), ends.log_odds.data(), ends.count, largest,
                                          precision);
}

}  // namespace softbody
#endif
