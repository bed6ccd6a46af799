#include "labels/labeling.h"

#include <opencv2/imgproc.hpp>

#include "labels/occluders.h"
#include "labels/pixel_labels.h"

namespace softbody {
namespace {

// Width of the labelled margin around the prediction [rad]: 24 px of an image with 640 x 480 pixels.
constexpr double kMargin = 0.039;
// Side of the square around a pixel whose mean decides [px]: single pixels are noise.
constexpr int kAround = 5;

/// @param action gets the pixels of each cell, and the cell.
template <typename Action>
void forEachCell(const cv::Size& image, LabelCells* cells, Action action) {
  for (cv::Point place(0, 0); place.y < cells->grid.height; ++place.y)
    for (place.x = 0; place.x < cells->grid.width; ++place.x)
      action(cells->pixels(place) & cv::Rect({}, image), &cells->at(place));
}

/// Means over the pixels around, of those on which the body is rendered.
cv::Mat1f meanOnBody(const cv::Mat1f& log_odds, const cv::Mat1f& rendered) {
  cv::Mat1f on_body, share, mean;
  cv::threshold(rendered, on_body, 0.0, 1.0, cv::THRESH_BINARY);
  cv::blur(on_body, share, {kAround, kAround});
  cv::blur(log_odds.mul(on_body), mean, {kAround, kAround});
  return mean / share;
}

}  // namespace

Labels labelsOf(const RgbdFrame& frame, const PredictedSurface& surface, const SurfaceSamples& samples,
                const RegionColors& colors, const LabelMemory& last, double error_m) {
  Labels labels;
  labels.error_m = error_m;
  if (samples.samples.empty()) return labels;
  const cv::Size image = frame.depth.size();
  const int margin_px = cvRound(kMargin * frame.camera.fx);
  LabelCells cells = makeCells(surface.image().region, samples, margin_px);
  labels.region = cv::Rect(cells.origin, cells.grid * cells.size_px) & cv::Rect({}, image);
  labels.label.create(labels.region.size());
  labels.log_odds.create(labels.region.size());
  labels.predicted.create(labels.region.size());
  const PixelLabeler pixels(frame, surface.image(), colors);
  forEachCell(image, &cells,
              [&](const cv::Rect& area, LabelCell* cell) { pixels.label(area, cell, &labels); });
  tellOccluders(samples, {last, frame.camera.fx, error_m, cvRound(kReach * frame.camera.fx)}, &cells);
  const cv::Mat1f mean_odds = meanOnBody(labels.log_odds, surface.image().depth(labels.region));
  forEachCell(image, &cells,
              [&](const cv::Rect& area, LabelCell* cell) { pixels.decide(area, *cell, mean_odds, &labels); });
  labels.memory = memoryOf(cells);
  return labels;
}

}  // namespace softbody
