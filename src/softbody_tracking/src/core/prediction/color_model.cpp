#include "prediction/color_model.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

namespace softbody {
namespace {

// Bins of the histogram: few for lightness, since the shadow of a hand darkens the body.
constexpr int kLightBins = 8, kChromaBins = 32;
// Pixels, below which nothing is learned: a few pixels may show anything.
constexpr int kFewestPixels = 200;
// Density of a bin, relative to a typical pixel of the body, from which its colour belongs to the body.
constexpr float kSmallestDensity = 0.02f;
// Largest depth difference of a pixel to learn from [m]; a little above the noise and the registration's
// error.
constexpr double kLearnTolerance = 0.008;

/// Bin of a Lab pixel.
int binOf(const cv::Vec3b& lab) {
  const int light = lab[0] * kLightBins / 256;
  return (light * kChromaBins + lab[1] * kChromaBins / 256) * kChromaBins + lab[2] * kChromaBins / 256;
}

/// Blurs the counts over neighbouring bins, so that colours between learned ones belong to the body too.
cv::Mat1f smoothed(const cv::Mat1f& counts) {
  cv::Mat1f result(counts.size());
  std::vector<cv::Mat1f> layers;
  for (int l = 0; l < kLightBins; ++l) {
    cv::Mat1f layer;
    cv::GaussianBlur(counts.rowRange(l * kChromaBins * kChromaBins, (l + 1) * kChromaBins * kChromaBins)
                         .reshape(1, kChromaBins),
                     layer, cv::Size(5, 5), 1.0);
    layers.push_back(layer);
  }
  for (int l = 0; l < kLightBins; ++l) {
    cv::Mat1f sum = layers[l] * 0.5f;
    sum += 0.25f * layers[std::max(0, l - 1)];
    sum += 0.25f * layers[std::min(kLightBins - 1, l + 1)];
    cv::Mat1f rows = result.rowRange(l * kChromaBins * kChromaBins, (l + 1) * kChromaBins * kChromaBins);
    cv::Mat(sum.reshape(1, kChromaBins * kChromaBins)).copyTo(rows);
  }
  return result;
}

cv::Mat3b toLab(const cv::Mat3b& color) {
  cv::Mat blurred;
  cv::Mat3b lab;
  cv::GaussianBlur(color, blurred, cv::Size(3, 3), 0.0);
  cv::cvtColor(blurred, lab, cv::COLOR_BGR2Lab);
  return lab;
}

}  // namespace

cv::Mat3b paletteInLab() {
  cv::Mat3b palette(1, 32 * 32 * 32), lab;
  for (int i = 0; i < palette.cols; ++i) {
    const auto middle = [](int bin) { return static_cast<uchar>(8 * bin + 4); };
    palette(0, i) = {middle(i >> 10), middle(i >> 5 & 31), middle(i & 31)};
  }
  cv::cvtColor(palette, lab, cv::COLOR_BGR2Lab);
  return lab;
}

void ColorModel::learn(const cv::Mat3b& color, const cv::Mat1b& mask) {
  if (cv::countNonZero(mask) < kFewestPixels) return;
  const cv::Mat3b lab = toLab(color);
  cv::Mat1f counts(kLightBins * kChromaBins * kChromaBins, 1, 0.0f);
  for (int v = 0; v < lab.rows; ++v) {
    for (int u = 0; u < lab.cols; ++u) {
      if (mask(v, u) != 0) counts(binOf(lab(v, u))) += 1.0f;
    }
  }
  const cv::Mat1f density = smoothed(counts);
  // Mean density over the body's pixels: sum of squares over sum.
  const double typical = cv::sum(density.mul(counts))[0] / cv::sum(counts)[0];
  of_body_.resize(static_cast<std::size_t>(palette_.cols));
  for (int i = 0; i < palette_.cols; ++i) {
    of_body_[i] = density(binOf(palette_(0, i))) >= kSmallestDensity * typical ? 1 : 0;
  }
}

cv::Mat1b ColorModel::mask(const cv::Mat3b& color, const cv::Rect& region) const {
  if (!learned()) return cv::Mat1b(color.size(), 255);
  cv::Mat1b result(color.size(), 0);
  for (int v = region.y; v < region.br().y; ++v) {
    for (int u = region.x; u < region.br().x; ++u) result(v, u) = belongs(color(v, u)) ? 255 : 0;
  }
  return result;
}

cv::Mat1b agreeingPixels(const cv::Mat1f& rendered, const cv::Mat1f& measured) {
  cv::Mat1b mask(rendered.size(), 0);
  for (int v = 0; v < mask.rows; ++v) {
    for (int u = 0; u < mask.cols; ++u) {
      const bool agrees =
          rendered(v, u) > 0.0f && std::abs(rendered(v, u) - measured(v, u)) < kLearnTolerance;
      mask(v, u) = agrees ? 255 : 0;
    }
  }
  cv::erode(mask, mask, cv::Mat());
  return mask;
}

}  // namespace softbody
