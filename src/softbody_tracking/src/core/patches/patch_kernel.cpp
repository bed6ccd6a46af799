#include "patches/patch_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "patches/patch_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h:
#include <hwy/highway.h>

#ifndef SOFTBODY_PATCH_GRID
#define SOFTBODY_PATCH_GRID
namespace softbody {

/// Places of the samples before the warp; padding stays in the middle and does not count.
struct alignas(64) PatchGrid {
  constexpr PatchGrid() : x(), y(), counts() {
    for (int i = 0; i < kPatchSize; ++i) {
      x[i] = static_cast<float>(i % kPatchSide - kPatchSide / 2);
      y[i] = static_cast<float>(i / kPatchSide - kPatchSide / 2);
      counts[i] = 1.0f;
    }
  }
  float x[PatchSamples::kPadded], y[PatchSamples::kPadded], counts[PatchSamples::kPadded];
};
inline constexpr PatchGrid kPatchGrid;

/// An image, and how the grid lies in it.
struct PatchView {
  const unsigned char* image;
  std::int32_t last_u, last_v;  ///< that are upper left pixels of four [px]
  std::int32_t stride;          ///< [elements]
  float center_u, center_v, ux, uy, vx, vy;
};

}  // namespace softbody
#endif

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Sums are taken in 16 lanes, whatever the vectors' width, and nothing is fused: all widths round alike.
constexpr int kLanes = PatchSamples::kLanes;
using Floats = hn::CappedTag<float, kLanes>;
using Ints = hn::RebindToSigned<Floats>;
constexpr int kWidth = static_cast<int>(hn::MaxLanes(Floats()));

/// Where the samples lie in the image.
struct alignas(64) Places {
  std::int32_t offsets[PatchSamples::kPadded];                      ///< of the upper left pixel [elements]
  float right[PatchSamples::kPadded], down[PatchSamples::kPadded];  ///< from there [px]
};

HWY_INLINE void place(const PatchView& view, Places* places) {
  const Floats df;
  const Ints di;
  const auto center_u = hn::Set(df, view.center_u), center_v = hn::Set(df, view.center_v);
  const auto ux = hn::Set(df, view.ux), uy = hn::Set(df, view.uy);
  const auto vx = hn::Set(df, view.vx), vy = hn::Set(df, view.vy);
  // Rounding may take the last sample onto the border, whose right or lower neighbour is no pixel.
  const auto last_u = hn::Set(di, view.last_u), last_v = hn::Set(di, view.last_v);
  const auto stride = hn::Set(di, view.stride);
  for (int i = 0; i < PatchSamples::kPadded; i += kWidth) {
    const auto x = hn::Load(df, kPatchGrid.x + i), y = hn::Load(df, kPatchGrid.y + i);
    const auto u = hn::Add(hn::Add(center_u, hn::Mul(ux, x)), hn::Mul(uy, y));
    const auto v = hn::Add(hn::Add(center_v, hn::Mul(vx, x)), hn::Mul(vy, y));
    const auto u0 = hn::Min(hn::ConvertTo(di, u), last_u), v0 = hn::Min(hn::ConvertTo(di, v), last_v);
    hn::Store(hn::Sub(u, hn::ConvertTo(df, u0)), df, places->right + i);
    hn::Store(hn::Sub(v, hn::ConvertTo(df, v0)), df, places->down + i);
    hn::Store(hn::Add(hn::Mul(v0, stride), u0), di, places->offsets + i);
  }
}

template <int kByte, class V>
HWY_INLINE hn::Vec<Floats> byteOf(V pixels) {
  const Ints di;
  const hn::RebindToUnsigned<Floats> du;
  return hn::ConvertTo(Floats(),
                       hn::BitCast(di, hn::And(hn::ShiftRight<8 * kByte>(pixels), hn::Set(du, 255u))));
}

/// Bilinear samples, a vector at a time.
class Samples {
 public:
  HWY_INLINE explicit Samples(const PatchView& view) {
    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the first pixel is the lowest byte");
    place(view, &places_);
    for (int i = 0; i < PatchSamples::kPadded; ++i)
      std::memcpy(pixels_ + i, view.image + 2 * static_cast<std::ptrdiff_t>(places_.offsets[i]), 4);
  }

  HWY_INLINE hn::Vec<Floats> at(int i) const {
    const Floats df;
    const hn::RebindToUnsigned<Floats> du;
    const auto four = hn::Load(du, pixels_ + i);
    const auto a = hn::Load(df, places_.right + i), b = hn::Load(df, places_.down + i);
    const auto p00 = byteOf<0>(four), p10 = byteOf<1>(four), p01 = byteOf<2>(four), p11 = byteOf<3>(four);
    const auto top = hn::Add(p00, hn::Mul(a, hn::Sub(p01, p00)));
    const auto bottom = hn::Add(p10, hn::Mul(a, hn::Sub(p11, p10)));
    return hn::Add(top, hn::Mul(b, hn::Sub(bottom, top)));
  }

 private:
  Places places_;
  alignas(64) std::uint32_t pixels_[PatchSamples::kPadded];
};

void sample(const PatchView& view, float* values) {
  const Floats df;
  const Samples samples(view);
  for (int i = 0; i < PatchSamples::kPadded; i += kWidth)
    hn::Store(hn::Mul(samples.at(i), hn::Load(df, kPatchGrid.counts + i)), df, values + i);
}

constexpr int kParts = kLanes / kWidth;

/// A sum in 16 lanes.
struct Sum {
  HWY_INLINE Sum() {
    for (auto& part : parts) part = hn::Zero(Floats());
  }
  HWY_INLINE void add(int part, hn::Vec<Floats> v) { parts[part] = hn::Add(parts[part], v); }
  HWY_INLINE float total() const {
    alignas(64) float lanes[kLanes];
    for (int part = 0, first = 0; part < kParts; ++part, first += kWidth)
      hn::Store(parts[part], Floats(), lanes + first);
    // The same pairs are added whatever the width.
    const hn::CappedTag<float, 4> few;
    constexpr int kFew = static_cast<int>(hn::MaxLanes(few));
    for (int half = kLanes / 2; half >= kFew; half /= 2) {
      for (int i = 0; i < half; i += kFew)
        hn::Store(hn::Add(hn::Load(few, lanes + i), hn::Load(few, lanes + i + half)), few, lanes + i);
    }
    for (int half = kFew / 2; half > 0; half /= 2) {
      for (int i = 0; i < half; ++i) lanes[i] += lanes[i + half];
    }
    return lanes[0];
  }
  hn::Vec<Floats> parts[kParts];
};

/// @param sums spread squared, product, along x, along y.
void compare(const PatchView& view, const float* values, const float* dx, const float* dy, float* sums) {
  const Floats df;
  const Samples samples(view);
  // Sums of differences from the middle's grey lose fewer digits than sums of greys.
  const auto middle =
      static_cast<std::ptrdiff_t>(view.center_v) * view.stride + static_cast<std::ptrdiff_t>(view.center_u);
  const auto gray = hn::Set(df, static_cast<float>(view.image[2 * middle]));
  Sum all, square, product, along_x, along_y;
  for (int i = 0; i < PatchSamples::kPadded; i += kLanes) {
    for (int part = 0; part < kParts; ++part) {
      const int k = i + part * kWidth;
      const auto c = hn::Mul(hn::Sub(samples.at(k), gray), hn::Load(df, kPatchGrid.counts + k));
      all.add(part, c);
      square.add(part, hn::Mul(c, c));
      // Templates have mean 0: that of the samples does not count.
      product.add(part, hn::Mul(c, hn::Load(df, values + k)));
      along_x.add(part, hn::Mul(c, hn::Load(df, dx + k)));
      along_y.add(part, hn::Mul(c, hn::Load(df, dy + k)));
    }
  }
  const float sum = all.total();
  sums[0] = square.total() - sum * sum / static_cast<float>(kPatchSize);
  sums[1] = product.total();
  sums[2] = along_x.total();
  sums[3] = along_y.total();
}

}  // namespace

// Functions of the table have external linkage.
void sampleFloats(const PatchView& view, float* values) { sample(view, values); }
void compareFloats(const PatchView& view, const float* values, const float* dx, const float* dy,
                   float* sums) {
  compare(view, values, dx, dy, sums);
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {
namespace {

PatchView viewOf(const RowPairs& image, const cv::Point2f& center, const Eigen::Matrix2f& warp) {
  return {image.data, image.cols - 2, image.rows - 1, static_cast<std::int32_t>(image.step1() / 2),
          center.x,   center.y,       warp(0, 0),     warp(0, 1),
          warp(1, 0), warp(1, 1)};
}

}  // namespace

HWY_EXPORT(sampleFloats);
HWY_EXPORT(compareFloats);

void samplePatch(const RowPairs& image, const cv::Point2f& center, const Eigen::Matrix2f& warp,
                 PatchSamples* samples) {
  HWY_DYNAMIC_DISPATCH(sampleFloats)(viewOf(image, center, warp), samples->values.data());
}

PatchSums comparePatch(const RowPairs& image, const cv::Point2f& center, const Eigen::Matrix2f& warp,
                       const PatchTemplate& pattern) {
  float sums[4];
  HWY_DYNAMIC_DISPATCH(compareFloats)
  (viewOf(image, center, warp), pattern.values.values.data(), pattern.dx.values.data(),
   pattern.dy.values.data(), sums);
  return {std::sqrt(std::max(0.0f, sums[0])), sums[1], sums[2], sums[3]};
}

}  // namespace softbody
#endif
