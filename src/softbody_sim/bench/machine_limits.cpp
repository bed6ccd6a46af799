#include "bench/machine_limits.h"

#include <algorithm>
#include <vector>

#include "bench/wall_time.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/machine_limits.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
constexpr hn::ScalableTag<float> kLanes;
using Vector = hn::Vec<decltype(kLanes)>;

}  // namespace

/// @param count a multiple of all vectors' lengths, as below.
void triad(const float* b, const float* c, std::size_t count, float* a) {
  const Vector s = hn::Set(kLanes, 3.0f);
  for (std::size_t i = 0; i < count; i += hn::Lanes(kLanes))
    hn::StoreU(hn::MulAdd(s, hn::LoadU(kLanes, c + i), hn::LoadU(kLanes, b + i)), kLanes, a + i);
}

/// Eight sums at once: none waits for the one before.
float sum(const float* a, std::size_t count) {
  const std::size_t n = hn::Lanes(kLanes);
  Vector s0 = hn::Zero(kLanes), s1 = s0, s2 = s0, s3 = s0, s4 = s0, s5 = s0, s6 = s0, s7 = s0;
  for (std::size_t i = 0; i < count; i += 8 * n) {
    s0 = hn::Add(s0, hn::LoadU(kLanes, a + i)), s1 = hn::Add(s1, hn::LoadU(kLanes, a + i + n));
    s2 = hn::Add(s2, hn::LoadU(kLanes, a + i + 2 * n)), s3 = hn::Add(s3, hn::LoadU(kLanes, a + i + 3 * n));
    s4 = hn::Add(s4, hn::LoadU(kLanes, a + i + 4 * n)), s5 = hn::Add(s5, hn::LoadU(kLanes, a + i + 5 * n));
    s6 = hn::Add(s6, hn::LoadU(kLanes, a + i + 6 * n)), s7 = hn::Add(s7, hn::LoadU(kLanes, a + i + 7 * n));
  }
  const Vector all =
      hn::Add(hn::Add(hn::Add(s0, s1), hn::Add(s2, s3)), hn::Add(hn::Add(s4, s5), hn::Add(s6, s7)));
  return hn::GetLane(hn::SumOfLanes(kLanes, all));
}

/// Ten multiply-adds at once in each round. @param operations their number.
float multiplyAdd(float x, std::size_t rounds, double* operations) {
  const Vector a = hn::Set(kLanes, 0.5f), b = hn::Set(kLanes, 0.5f);
  // Different starts: the compiler would merge equal sums.
  const auto start = [x](float k) { return hn::Set(kLanes, x + k); };
  Vector s0 = start(0), s1 = start(1), s2 = start(2), s3 = start(3), s4 = start(4), s5 = start(5),
         s6 = start(6), s7 = start(7), s8 = start(8), s9 = start(9);
  for (std::size_t i = 0; i < rounds; ++i) {
    s0 = hn::MulAdd(s0, a, b), s1 = hn::MulAdd(s1, a, b), s2 = hn::MulAdd(s2, a, b);
    s3 = hn::MulAdd(s3, a, b), s4 = hn::MulAdd(s4, a, b), s5 = hn::MulAdd(s5, a, b);
    s6 = hn::MulAdd(s6, a, b), s7 = hn::MulAdd(s7, a, b), s8 = hn::MulAdd(s8, a, b);
    s9 = hn::MulAdd(s9, a, b);
  }
  *operations = 20.0 * static_cast<double>(rounds * hn::Lanes(kLanes));
  const Vector all =
      hn::Add(hn::Add(hn::Add(s0, s1), hn::Add(s2, s3)), hn::Add(hn::Add(s4, s5), hn::Add(s6, s7)));
  return hn::GetLane(hn::SumOfLanes(kLanes, hn::Add(all, hn::Add(s8, s9))));
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {
HWY_EXPORT(triad);
HWY_EXPORT(sum);
HWY_EXPORT(multiplyAdd);

namespace bench {
namespace {

constexpr int kPasses = 30;
constexpr double kLeast_s = 1e-3;  // of a pass
volatile float unused;             // keeps results that nobody reads

std::size_t padded(std::size_t count) {
  constexpr std::size_t kMultiple = 1024;
  return (count + kMultiple - 1) / kMultiple * kMultiple;
}

/// Shortest time of one repetition in several passes [s].
template <typename Work>
double shortest(const Work& work) {
  work();
  const int repetitions = 1 + static_cast<int>(kLeast_s / std::max(1e-7, secondsOf(work)));
  double least = 1e9;
  for (int pass = 0; pass < kPasses; ++pass) {
    const double time = secondsOf([&] {
      for (int k = 0; k < repetitions; ++k) work();
    });
    least = std::min(least, time / repetitions);
  }
  return least;
}

}  // namespace

double triadBandwidth(std::size_t bytes) {
  const std::size_t count = padded(bytes / (3 * sizeof(float)));
  std::vector<float> a(count, 1.0f), b(count, 2.0f), c(count, 3.0f);
  const double time = shortest([&] { HWY_DYNAMIC_DISPATCH(triad)(b.data(), c.data(), count, a.data()); });
  unused = a[count / 2];
  return 3.0 * sizeof(float) * static_cast<double>(count) / time;
}

double readBandwidth(std::size_t bytes) {
  const std::size_t count = padded(bytes / sizeof(float));
  const std::vector<float> a(count, 1.0f);
  const double time = shortest([&] { unused = HWY_DYNAMIC_DISPATCH(sum)(a.data(), count); });
  return sizeof(float) * static_cast<double>(count) / time;
}

double peakOperations() {
  double operations = 0.0;
  const double time =
      shortest([&] { unused = HWY_DYNAMIC_DISPATCH(multiplyAdd)(1.0f, 100'000, &operations); });
  return operations / time;
}

}  // namespace bench
}  // namespace softbody
#endif
