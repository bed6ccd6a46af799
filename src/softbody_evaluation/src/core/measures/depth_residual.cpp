#include "softbody_evaluation/measures/depth_residual.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace softbody::evaluation {

FrameResidual depthResidual(const cv::Mat1f& model, const cv::Mat1f& measured, double occluder_m) {
  if (model.size() != measured.size()) {
    throw std::invalid_argument(
        fmt::format("the depth image has {} x {} pixels, but the camera_info has {} x {}", measured.cols,
                    measured.rows, model.cols, model.rows));
  }
  FrameResidual frame;
  for (int v = 0; v < model.rows; ++v) {
    for (int u = 0; u < model.cols; ++u) {
      if (!(model(v, u) > 0.0f)) continue;
      ++frame.model_pixels;
      const float z = measured(v, u);
      if (!(z > 0.0f) || !std::isfinite(z)) {
        ++frame.without_depth;
      } else if (model(v, u) - z > occluder_m) {
        ++frame.occluded;
      } else {
        frame.residuals.push_back(std::abs(model(v, u) - z));
      }
    }
  }
  return frame;
}

ResidualReport summarize(const std::vector<FrameResidual>& frames, std::size_t first, std::size_t count) {
  ResidualReport report;
  report.first_frame = first;
  std::vector<float> residuals;
  std::size_t model_pixels = 0, occluded = 0, without_depth = 0;
  for (std::size_t i = first; i < frames.size() && i - first < count; ++i) {
    ++report.frames;
    report.answered += frames[i].model_pixels > 0 ? 1 : 0;
    residuals.insert(residuals.end(), frames[i].residuals.begin(), frames[i].residuals.end());
    model_pixels += frames[i].model_pixels;
    occluded += frames[i].occluded;
    without_depth += frames[i].without_depth;
  }
  report.within_10mm = shareWithin(residuals, 0.010);
  report.within_15mm = shareWithin(residuals, 0.015);
  // A surface that lags behind the body looks occluded. Therefore the strict share counts occluded pixels.
  const double hits = residuals.empty() ? 0.0 : report.within_15mm * static_cast<double>(residuals.size());
  report.within_15mm_of_measured = hits / static_cast<double>(residuals.size() + occluded);
  report.residual = summarize(std::move(residuals));
  if (model_pixels > 0) {
    report.occluded_share = static_cast<double>(occluded) / static_cast<double>(model_pixels);
    report.without_depth_share = static_cast<double>(without_depth) / static_cast<double>(model_pixels);
  }
  return report;
}

}  // namespace softbody::evaluation
