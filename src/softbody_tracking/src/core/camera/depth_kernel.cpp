#include "camera/depth_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "camera/depth_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#ifndef SOFTBODY_DEPTH_ROWS
#define SOFTBODY_DEPTH_ROWS
namespace softbody {

/// Raw and clean image, and memory for three rows in metres. Pixel u of a row is at u + 1; around the pixels
/// are zeros.
struct DepthRows {
  static constexpr std::size_t kPadding = 66;  // a pixel at each side, and the widest vector behind

  const unsigned char* raw;
  float* clean;
  std::size_t raw_bytes, clean_floats;  ///< from row to row
  std::size_t width, height;
  DepthLimits limits;
  float* metres;

  float* row(std::size_t i) const { return metres + (i % 3) * (width + kPadding); }
};

}  // namespace softbody
#endif

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Floats = hn::ScalableTag<float>;
using Vector = hn::Vec<Floats>;
using Mask = hn::Mask<Floats>;
constexpr std::size_t kMostLanes = hn::MaxLanes(Floats());
static_assert(kMostLanes + 2 <= DepthRows::kPadding);

HWY_INLINE Vector load(const float* depth) { return hn::LoadU(Floats(), depth); }
HWY_INLINE Vector load(const std::uint16_t* depth) {
  const hn::RebindToSigned<Floats> integers;
  return hn::ConvertTo(Floats(),
                       hn::PromoteTo(integers, hn::LoadU(hn::Rebind<std::uint16_t, Floats>(), depth)));
}

/// 0 for depth out of range. NaN fails both comparisons.
template <typename Depth>
HWY_INLINE void metresInRange(const Depth* raw, const DepthLimits& limits, std::size_t width, float* metres) {
  const Floats df;
  const auto convert = [&](const Depth* depth, float* result) {
    const Vector z = hn::Mul(load(depth), hn::Set(df, limits.unit_m));
    const Mask in_range = hn::And(hn::Ge(z, hn::Set(df, limits.min_m)), hn::Le(z, hn::Set(df, limits.max_m)));
    hn::StoreU(hn::IfThenElseZero(in_range, z), df, result);
  };
  std::size_t u = 0;
  for (; u + hn::Lanes(df) <= width; u += hn::Lanes(df)) convert(raw + u, metres + u);
  if (u == width) return;
  Depth last[kMostLanes] = {};
  std::memcpy(last, raw + u, (width - u) * sizeof(Depth));
  convert(last, metres + u);
}

HWY_INLINE Mask isNear(Vector neighbor, Vector z, Vector reach) {
  return hn::Le(hn::Abs(hn::Sub(neighbor, z)), reach);
}

/// Whether z lies between a and b and is near neither.
HWY_INLINE Mask isStep(Vector a, Vector b, Vector z, Vector reach) {
  const Vector nearer = hn::Min(a, b), farther = hn::Max(a, b);
  return hn::And(hn::And(hn::Gt(nearer, hn::Zero(Floats())), hn::Lt(nearer, hn::Sub(z, reach))),
                 hn::Gt(farther, hn::Add(z, reach)));
}

/// Whether at least two of the masks are set: a thin wire has two near neighbours, a stray pixel has none.
class AtLeastTwo {
 public:
  HWY_INLINE AtLeastTwo() : one_(hn::Gt(hn::Zero(Floats()), hn::Zero(Floats()))), two_(one_) {}
  HWY_INLINE void add(Mask mask) {
    two_ = hn::Or(two_, hn::And(one_, mask));
    one_ = hn::Or(one_, mask);
  }
  HWY_INLINE Mask get() const { return two_; }

 private:
  Mask one_, two_;
};

/// Whether pixels are on a surface. @param above, row, below begin one pixel to the left.
HWY_INLINE Mask isOnSurface(const float* above, const float* row, const float* below, float ratio) {
  const Vector z = load(row + 1), reach = hn::Mul(hn::Set(Floats(), ratio), z);
  const Vector diagonal = hn::Mul(hn::Set(Floats(), static_cast<float>(M_SQRT2)), reach);
  AtLeastTwo support;
  Mask step = hn::Gt(hn::Zero(Floats()), hn::Zero(Floats()));
  const auto compare = [&](const float* a, const float* b, Vector r) {
    support.add(isNear(load(a), z, r));
    support.add(isNear(load(b), z, r));
    step = hn::Or(step, isStep(load(a), load(b), z, r));
  };
  compare(row, row + 2, reach);
  compare(above + 1, below + 1, reach);
  compare(above, below + 2, diagonal);
  compare(above + 2, below, diagonal);
  return hn::AndNot(step, support.get());
}

template <bool kFilters>
HWY_INLINE void cleanRow(const DepthRows& image, std::size_t v, float* clean) {
  const Floats df;
  const float *above = image.row(v), *row = image.row(v + 1), *below = image.row(v + 2);
  const Vector none = hn::Set(df, std::numeric_limits<float>::quiet_NaN());
  for (std::size_t u = 0; u < image.width; u += hn::Lanes(df)) {
    const Vector z = load(row + u + 1);
    Mask kept = hn::Gt(z, hn::Zero(df));
    if constexpr (kFilters)
      kept = hn::And(kept, isOnSurface(above + u, row + u, below + u, image.limits.jump_ratio));
    const Vector result = hn::IfThenElse(kept, z, none);
    if (u + hn::Lanes(df) <= image.width) {
      hn::StoreU(result, df, clean + u);
    } else {
      float last[kMostLanes];
      hn::StoreU(result, df, last);
      std::memcpy(clean + u, last, (image.width - u) * sizeof(float));
    }
  }
}

/// Row v of the image is row v + 1 in metres.
template <typename Depth>
void clean(const DepthRows& image) {
  const auto read = [&](std::size_t v) {
    const auto* raw = reinterpret_cast<const Depth*>(image.raw + v * image.raw_bytes);
    metresInRange(raw, image.limits, image.width, image.row(v + 1) + 1);
  };
  read(0);
  for (std::size_t v = 0; v < image.height; ++v) {
    if (v + 1 < image.height)
      read(v + 1);
    else
      std::fill_n(image.row(v + 2), image.width + DepthRows::kPadding, 0.0f);
    float* result = image.clean + v * image.clean_floats;
    if (image.limits.jump_ratio > 0.0f)
      cleanRow<true>(image, v, result);
    else
      cleanRow<false>(image, v, result);
  }
}

}  // namespace

// Functions of the table have external linkage.
void cleanShorts(const DepthRows& image) { clean<std::uint16_t>(image); }
void cleanFloats(const DepthRows& image) { clean<float>(image); }

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {

HWY_EXPORT(cleanShorts);
HWY_EXPORT(cleanFloats);

void DepthCleaner::clean(const cv::Mat& raw, const DepthLimits& limits, cv::Mat1f* clean) {
  clean->create(raw.size());
  const auto width = static_cast<std::size_t>(raw.cols), height = static_cast<std::size_t>(raw.rows);
  if (height == 0) return;
  rows_.assign(3 * (width + DepthRows::kPadding), 0.0f);
  const DepthRows rows{raw.data, clean->ptr<float>(), raw.step[0], clean->step1(), width, height,
                       limits,   rows_.data()};
  if (raw.depth() == CV_16U)
    HWY_DYNAMIC_DISPATCH(cleanShorts)(rows);
  else
    HWY_DYNAMIC_DISPATCH(cleanFloats)(rows);
}

}  // namespace softbody
#endif
