#pragma once

#include <optional>

#include "labels/label_cells.h"
#include "labels/labels.h"
#include "labels/region_colors.h"
#include "labels/sectors.h"
#include "softbody_tracking/rgbd_frame.h"

namespace softbody {

/// Labels each pixel on its own, by its depth beside the prediction and by its colour.
class PixelLabeler {
 public:
  /// @param rendered depth of the prediction.
  PixelLabeler(const RgbdFrame& frame, const RasterImage& rendered, const RegionColors& colors)
      : frame_(frame),
        rendered_(rendered.depth),
        sectors_(rendered.region),
        colors_(colors),
        knows_(!frame.covered.empty() || !frame.known.empty()) {}

  /// Labels the pixels of a cell, and sums up in the cell what they show. On the surface only those count on
  /// which the body is rendered.
  void label(const cv::Rect& pixels, LabelCell* cell, Labels* labels) const;

  /// Labels the pixels of a cell again, knowing what it shows. In an occluder's cell only those still show
  /// the body that are nearer to its predicted depth than to the cell's. In another one the pixels around
  /// decide: a foreign colour alone does not make an occluder.
  /// @param mean_odds log odds of the body, each the mean of the pixels around on which it is rendered.
  void decide(const cv::Rect& pixels, const LabelCell& cell, const cv::Mat1f& mean_odds,
              Labels* labels) const;

 private:
  struct Sums;
  /// @param sector_at gets a pixel, and tells its sector.
  template <typename SectorAt>
  Sums labelEach(const cv::Rect& pixels, const LabelCell& cell, SectorAt sector_at, Labels* labels) const;
  /// Label by depth and colour. @param predicted depth of the body there [m]. @param log_odds by colour, then
  /// by both.
  std::uint8_t labelOf(float measured, float predicted, int sector, float* log_odds, Sums* sums) const;

  /// Label of a pixel that shows a known thing. @param predicted depth of the body there [m].
  std::optional<std::uint8_t> knownLabel(int u, int v, float predicted) const;

  static std::uint8_t unmeasuredLabel(const LabelCell& cell, bool on_body, float log_odds);
  std::uint8_t frontLabel(const LabelCell& cell, float measured, float rendered, bool body_alone,
                          float mean_odds) const;

  const RgbdFrame& frame_;
  const cv::Mat1f& rendered_;
  Sectors sectors_;
  const RegionColors& colors_;
  bool knows_;  ///< known things are in view
};

}  // namespace softbody
