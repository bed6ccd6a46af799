#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "labels/depth_evidence.h"
#include "labels/labels.h"
#include "labels/sectors.h"
#include "softbody_common/images/rasterizer.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Statistics of colour and depth on both sides of the body's outline: how much more often a colour, or a
/// difference of depth, occurs on the body than in its surroundings. The surroundings differ from sector to
/// sector, as in the local histograms of Tjaden et al. 2018: a thing like the body that lies on one side says
/// nothing there. They follow the light from frame to frame.
class RegionColors {
 public:
  RegionColors();

  /// Learns from the labelled part of a frame. A hand before the body is part of the surroundings, like what
  /// is beside the body.
  /// @param elapsed_s since the frame before.
  void learn(const RgbdFrame& frame, const RasterImage& rendered, const Labels& labels, double elapsed_s);

  bool learned() const { return !body_.empty(); }
  /// Log odds that a pixel of this colour (blue, green, red) shows the body; 0 before learn().
  float logOdds(const cv::Vec3b& color, int sector) const {
    return log_odds_[static_cast<std::size_t>(sector)][bin(color)];
  }
  /// The same by its depth. @param difference measured minus predicted depth [m]. @param predicted depth of
  /// the body [m].
  float depthLogOdds(float difference, float predicted, int sector) const {
    return depth_[static_cast<std::size_t>(sector)].logOdds(difference, predicted);
  }

  /// Whether a colour occurs on the body; every colour does before learn().
  bool belongs(const cv::Vec3b& color) const { return !learned() || inside_[bin(color)] >= kRare; }
  /// Mask of the image's size: 255 inside the region at pixels whose colours belong to the body, else 0.
  cv::Mat1b mask(const cv::Mat3b& color, const cv::Rect& region) const;

  /// Forgets what was learned.
  void reset();

 private:
  /// Density of a colour that was never seen: it speaks for neither side.
  static constexpr float kUnseen = 1e-3f;
  /// Density of a colour of the body at least.
  static constexpr float kRare = 1e-4f;
  static constexpr int kBins = 16 * 16 * 16;  ///< bin() keeps the upper 4 bits of each channel
  static std::size_t bin(const cv::Vec3b& color) {
    return static_cast<std::size_t>((color[0] >> 4) << 8 | (color[1] >> 4) << 4 | color[2] >> 4);
  }
  struct Counts;
  Counts countsIn(const RgbdFrame& frame, const RasterImage& rendered, const Labels& labels) const;
  void compareColors();

  std::vector<float> body_;    ///< share of the body's pixels in each bin; empty before learn()
  std::vector<float> inside_;  ///< the same, without pixels near the outline: they mix both sides
  std::array<std::vector<float>, Sectors::kCount> around_;  ///< pixels in each bin, mean of the last frames
  std::array<std::vector<float>, Sectors::kCount> log_odds_;
  std::array<DepthCounts, Sectors::kCount> depth_around_;  ///< likewise
  std::array<DepthEvidence, Sectors::kCount> depth_;
};

}  // namespace softbody
