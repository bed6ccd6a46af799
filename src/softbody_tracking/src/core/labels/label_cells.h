#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "prediction/surface_samples.h"

namespace softbody {

/// A block of pixels on or beside the predicted surface.
struct LabelCell {
  int sample = -1;           ///< the surface sample here, otherwise the nearest one; -1: there is none
  int distance = 0;          ///< from that sample [cells]
  bool shows_front = false;  ///< most of its pixels are measured, and not behind the body
  float predicted = 0.0f;    ///< depth of the sample [m]
  float difference = 0.0f;  ///< mean of measured minus predicted depth, of the pixels not behind the body [m]
  float color_odds = 0.0f;  ///< mean log odds of the body by colour, of the same pixels
  float body = 0.0f;        ///< probability that these pixels show the body, not an occluder

  float shift = 0.0f;  ///< by which the whole piece is farther than predicted [m]

  bool beside_occluder = false;  ///< a cell around it shows an occluder
  bool joined = false;           ///< an occluder's cell that belongs to an occluder before the body

  bool onSurface() const { return distance == 0; }
  bool showsOccluder() const { return shows_front && body < 0.5f; }
  float measured() const { return predicted + difference; }  ///< mean depth [m]
};

/// Cells on a regular grid: the blocks of the surface samples, and a margin around them.
struct LabelCells {
  int size_px = 1;   ///< side of a cell
  cv::Point origin;  ///< first pixel of the first cell; may be outside of the image [px]
  cv::Size grid;
  std::vector<LabelCell> cells;  ///< row by row

  LabelCell& at(const cv::Point& place) { return cells[index(place)]; }
  const LabelCell& at(const cv::Point& place) const { return cells[index(place)]; }
  bool contains(const cv::Point& place) const { return cv::Rect({}, grid).contains(place); }
  /// Pixels of a cell. Some may be outside of the image.
  cv::Rect pixels(const cv::Point& place) const {
    return {origin + size_px * place, cv::Size(size_px, size_px)};
  }

 private:
  std::size_t index(const cv::Point& place) const {
    return static_cast<std::size_t>(place.y) * static_cast<std::size_t>(grid.width) +
           static_cast<std::size_t>(place.x);
  }
};

/// The cells around a rendered surface, without what the frame shows there.
/// @param region of the image that the samples cover. @param margin_px width of the margin.
LabelCells makeCells(const cv::Rect& region, const SurfaceSamples& samples, int margin_px);

}  // namespace softbody
