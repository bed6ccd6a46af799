#include "texture/exposure.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/statistics/median.h"

namespace softbody::scanning {
namespace {

constexpr std::size_t kTriangles = 3000;               // are enough for some hundred gains
constexpr int kRounds = 5;                             // of reweighting
constexpr float kDarkest = 8.0f, kBrightest = 247.0f;  // beyond, a gain is lost in noise or saturation
constexpr double kPrior = 1e-3;  // of a view: a frame without overlap keeps its exposure

/// One channel of what the frames show of one triangle.
struct Overlap {
  std::vector<int> frames;
  std::vector<double> logs, weights;

  /// Weighted mean of log - gain: the triangle's own colour.
  double own(const Eigen::VectorXd& gains) const {
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      sum += weights[i] * (logs[i] - gains[frames[i]]);
      weight += weights[i];
    }
    return sum / weight;
  }
};

std::vector<Overlap> overlapsOf(const TriangleViews& views, int channel) {
  std::vector<Overlap> overlaps;
  const std::size_t step = 1 + views.size() / kTriangles;
  for (std::size_t t = 0; t < views.size(); t += step) {
    Overlap overlap;
    for (const TriangleView& view : views[t]) {
      const float value = view.color[channel];
      if (value < kDarkest || value > kBrightest) continue;
      overlap.frames.push_back(view.frame);
      overlap.logs.push_back(std::log(static_cast<double>(value)));
      overlap.weights.push_back(1.0);
    }
    if (overlap.frames.size() > 1) overlaps.push_back(std::move(overlap));
  }
  return overlaps;
}

/// Medians of what each frame shows, over the triangles' medians: whatever covers less than half of a frame
/// does not matter.
Eigen::VectorXd roughGains(const std::vector<Overlap>& overlaps, Eigen::Index frames) {
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(frames);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<std::vector<double>> differences(static_cast<std::size_t>(frames));
    for (const Overlap& overlap : overlaps) {
      std::vector<double> own = overlap.logs;
      for (std::size_t i = 0; i < own.size(); ++i) own[i] -= gains[overlap.frames[i]];
      const double median = medianOf(own);
      for (std::size_t i = 0; i < own.size(); ++i)
        differences[static_cast<std::size_t>(overlap.frames[i])].push_back(overlap.logs[i] - median);
    }
    for (Eigen::Index f = 0; f < frames; ++f) {
      auto& of_frame = differences[static_cast<std::size_t>(f)];
      if (!of_frame.empty()) gains[f] = medianOf(std::move(of_frame));
    }
    gains.array() -= gains.mean();
  }
  return gains;
}

/// Least squares; the triangles' own colours are eliminated.
Eigen::VectorXd solveGains(const std::vector<Overlap>& overlaps, Eigen::Index frames) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Constant(frames, frames, 1.0);  // the mean is zero
  A.diagonal().array() += kPrior;
  Eigen::VectorXd b = Eigen::VectorXd::Zero(frames);
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(frames);
  for (const Overlap& overlap : overlaps) {
    const double own = overlap.own(none);
    double sum = 0.0;
    for (const double weight : overlap.weights) sum += weight;
    for (std::size_t i = 0; i < overlap.frames.size(); ++i) {
      const int f = overlap.frames[i];
      A(f, f) += overlap.weights[i];
      b[f] += overlap.weights[i] * (overlap.logs[i] - own);
      for (std::size_t j = 0; j < overlap.frames.size(); ++j)
        A(f, overlap.frames[j]) -= overlap.weights[i] * overlap.weights[j] / sum;
    }
  }
  return A.ldlt().solve(b);
}

/// Geman and McClure's weights for the spread that the residuals have.
void reweigh(const Eigen::VectorXd& gains, std::vector<Overlap>* overlaps) {
  std::vector<double> sizes;
  for (const Overlap& overlap : *overlaps) {
    const double own = overlap.own(gains);
    for (std::size_t i = 0; i < overlap.frames.size(); ++i)
      sizes.push_back(std::abs(overlap.logs[i] - gains[overlap.frames[i]] - own));
  }
  if (sizes.empty()) return;
  const double scale = 2.0 * medianOf(std::move(sizes)) / kMedianPerSigma + 1e-4;
  for (Overlap& overlap : *overlaps) {
    const double own = overlap.own(gains);
    for (std::size_t i = 0; i < overlap.frames.size(); ++i) {
      const double residual = (overlap.logs[i] - gains[overlap.frames[i]] - own) / scale;
      overlap.weights[i] = 1.0 / std::pow(1.0 + residual * residual, 2.0) + 1e-6;
    }
  }
}

}  // namespace

std::vector<cv::Vec3f> exposureGains(const TriangleViews& views, std::size_t frames) {
  std::vector<cv::Vec3f> gains(frames);
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<Overlap> overlaps = overlapsOf(views, channel);
    Eigen::VectorXd logs = roughGains(overlaps, static_cast<Eigen::Index>(frames));
    for (int round = 0; round < kRounds; ++round) {
      reweigh(logs, &overlaps);
      logs = solveGains(overlaps, logs.size());
    }
    for (std::size_t f = 0; f < frames; ++f)
      gains[f][channel] = static_cast<float>(std::exp(logs[static_cast<Eigen::Index>(f)]));
  }
  return gains;
}

void divideByGains(const std::vector<cv::Vec3f>& gains, TriangleViews* views) {
  for (auto& of_triangle : *views) {
    for (TriangleView& view : of_triangle)
      cv::divide(view.color, gains[static_cast<std::size_t>(view.frame)], view.color);
  }
}

}  // namespace softbody::scanning
