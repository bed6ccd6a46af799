#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>

namespace softbody {

constexpr int kPatchSide = 11;  ///< [px]
constexpr int kPatchSize = kPatchSide * kPatchSide;

/// A value for every pixel of a patch, row by row, padded with zeros to whole vectors.
struct alignas(64) PatchSamples {
  static constexpr int kLanes = 16;  ///< floats in the widest vector of the usual processors
  static constexpr int kPadded = (kPatchSize + kLanes - 1) / kLanes * kLanes;
  std::array<float, kPadded> values;
};

/// A patch with mean 0 and norm 1, and its derivatives per pixel to the right and downwards, with mean 0.
struct PatchTemplate {
  PatchSamples values, dx, dy;
};

/// Comparison of samples with a template; c are the samples minus their mean.
struct PatchSums {
  float spread = 0.0f;   ///< |c|
  float product = 0.0f;  ///< c . values
  float along_x = 0.0f;  ///< c . dx
  float along_y = 0.0f;  ///< c . dy
};

/// A grey image whose elements hold a pixel and the pixel below it: one read gives the four pixels of a
/// bilinear sample. It has one row less than the image.
using RowPairs = cv::Mat2b;

/// Bilinear samples on a grid of pixels about the centre, warped. Vectors of any width give the same bits.
/// @param center, warp must keep the grid inside the image.
void samplePatch(const RowPairs& image, const cv::Point2f& center, const Eigen::Matrix2f& warp,
                 PatchSamples* samples);

/// Compares such samples with a template. Vectors of any width give the same bits.
PatchSums comparePatch(const RowPairs& image, const cv::Point2f& center, const Eigen::Matrix2f& warp,
                       const PatchTemplate& pattern);

}  // namespace softbody
