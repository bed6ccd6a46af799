#include "core/patch_kernel.h"

#include <cmath>
#include <cstdint>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/patch_kernel.cpp"
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

}  // namespace softbody
#endif

HWY_BEFORE_NAMESPACE();
namespace softbody::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

// Sums are taken in 16 lanes, whatever the vectors' width, and nothing is fused: all widths round alike.
constexpr int kLanes = 16;
using Floats = hn::CappedTag<float, kLanes>;
using Ints = hn::RebindToSigned<Floats>;
constexpr int kWidth = static_cast<int>(hn::MaxLanes(Floats()));

/// The 2 by 2 pixels at every offset, a byte each.
HWY_INLINE void gatherPixels(const unsigned char* image, std::size_t stride, const std::int32_t* offsets,
                             std::uint32_t* pixels) {
  static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the first pixel is the lowest byte");
  for (int i = 0; i < PatchSamples::kPadded; ++i) {
    std::uint16_t top, bottom;
    std::memcpy(&top, image + offsets[i], 2);
    std::memcpy(&bottom, image + offsets[i] + stride, 2);
    pixels[i] = static_cast<std::uint32_t>(top) | static_cast<std::uint32_t>(bottom) << 16;
  }
}

template <int kByte, class V>
HWY_INLINE hn::Vec<Floats> byteOf(V pixels) {
  const Ints di;
  const hn::RebindToUnsigned<Floats> du;
  return hn::ConvertTo(Floats(),
                       hn::BitCast(di, hn::And(hn::ShiftRight<8 * kByte>(pixels), hn::Set(du, 255u))));
}

void sample(const unsigned char* image, int columns, int rows, std::size_t stride,
            const float* center_and_warp, float* values) {
  const Floats df;
  const Ints di;
  const hn::RebindToUnsigned<Floats> du;
  alignas(64) std::int32_t offsets[PatchSamples::kPadded];
  alignas(64) std::uint32_t pixels[PatchSamples::kPadded];
  alignas(64) float right[PatchSamples::kPadded], down[PatchSamples::kPadded];
  const auto center_u = hn::Set(df, center_and_warp[0]), center_v = hn::Set(df, center_and_warp[1]);
  const auto ux = hn::Set(df, center_and_warp[2]), uy = hn::Set(df, center_and_warp[3]);
  const auto vx = hn::Set(df, center_and_warp[4]), vy = hn::Set(df, center_and_warp[5]);
  // Rounding may take the last sample onto the border, whose right or lower neighbour is no pixel.
  const auto last_u = hn::Set(di, columns - 2), last_v = hn::Set(di, rows - 2);
  for (int i = 0; i < PatchSamples::kPadded; i += kWidth) {
    const auto x = hn::Load(df, kPatchGrid.x + i), y = hn::Load(df, kPatchGrid.y + i);
    const auto u = hn::Add(hn::Add(center_u, hn::Mul(ux, x)), hn::Mul(uy, y));
    const auto v = hn::Add(hn::Add(center_v, hn::Mul(vx, x)), hn::Mul(vy, y));
    const auto u0 = hn::Min(hn::ConvertTo(di, u), last_u), v0 = hn::Min(hn::ConvertTo(di, v), last_v);
    hn::Store(hn::Sub(u, hn::ConvertTo(df, u0)), df, right + i);
    hn::Store(hn::Sub(v, hn::ConvertTo(df, v0)), df, down + i);
    hn::Store(hn::Add(hn::Mul(v0, hn::Set(di, static_cast<std::int32_t>(stride))), u0), di, offsets + i);
  }
  gatherPixels(image, stride, offsets, pixels);
  for (int i = 0; i < PatchSamples::kPadded; i += kWidth) {
    const auto four = hn::Load(du, pixels + i);
    const auto a = hn::Load(df, right + i), b = hn::Load(df, down + i);
    const auto p00 = byteOf<0>(four), p01 = byteOf<1>(four), p10 = byteOf<2>(four), p11 = byteOf<3>(four);
    const auto top = hn::Add(p00, hn::Mul(a, hn::Sub(p01, p00)));
    const auto bottom = hn::Add(p10, hn::Mul(a, hn::Sub(p11, p10)));
    const auto value = hn::Add(top, hn::Mul(b, hn::Sub(bottom, top)));
    hn::Store(hn::Mul(value, hn::Load(df, kPatchGrid.counts + i)), df, values + i);
  }
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
void compare(const float* samples, const float* values, const float* dx, const float* dy, float* sums) {
  const Floats df;
  Sum all;
  for (int i = 0; i < PatchSamples::kPadded; i += kLanes) {
    for (int part = 0; part < kParts; ++part) all.add(part, hn::Load(df, samples + (i + part * kWidth)));
  }
  const auto mean = hn::Set(df, all.total() / static_cast<float>(kPatchSize));
  Sum square, product, along_x, along_y;
  for (int i = 0; i < PatchSamples::kPadded; i += kLanes) {
    for (int part = 0; part < kParts; ++part) {
      const int k = i + part * kWidth;
      const auto c = hn::Mul(hn::Sub(hn::Load(df, samples + k), mean), hn::Load(df, kPatchGrid.counts + k));
      square.add(part, hn::Mul(c, c));
      product.add(part, hn::Mul(c, hn::Load(df, values + k)));
      along_x.add(part, hn::Mul(c, hn::Load(df, dx + k)));
      along_y.add(part, hn::Mul(c, hn::Load(df, dy + k)));
    }
  }
  sums[0] = square.total();
  sums[1] = product.total();
  sums[2] = along_x.total();
  sums[3] = along_y.total();
}

}  // namespace

// Functions of the table have external linkage.
void sampleFloats(const unsigned char* image, int columns, int rows, std::size_t stride,
                  const float* center_and_warp, float* values) {
  sample(image, columns, rows, stride, center_and_warp, values);
}
void compareFloats(const float* samples, const float* values, const float* dx, const float* dy, float* sums) {
  compare(samples, values, dx, dy, sums);
}

}  // namespace softbody::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace softbody {

HWY_EXPORT(sampleFloats);
HWY_EXPORT(compareFloats);

void samplePatch(const cv::Mat1b& image, const cv::Point2f& center, const Eigen::Matrix2f& warp,
                 PatchSamples* samples) {
  const float center_and_warp[] = {center.x, center.y, warp(0, 0), warp(0, 1), warp(1, 0), warp(1, 1)};
  HWY_DYNAMIC_DISPATCH(sampleFloats)
  (image.data, image.cols, image.rows, image.step, center_and_warp, samples->values.data());
}

PatchSums comparePatch(const PatchSamples& samples, const PatchTemplate& pattern) {
  float sums[4];
  HWY_DYNAMIC_DISPATCH(compareFloats)
  (samples.values.data(), pattern.values.values.data(), pattern.dx.values.data(), pattern.dy.values.data(),
   sums);
  return {std::sqrt(sums[0]), sums[1], sums[2], sums[3]};
}

}  // namespace softbody
#endif
