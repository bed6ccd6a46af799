#include "labels/occluders.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "labels/depth_evidence.h"
#include "labels/labels.h"
#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

// Log odds of the body where it is predicted, before anything is measured.
constexpr double kPredicted = 2.0;
// Smallest standard deviation of the surface around the prediction, along its normal [m]: shape and noise.
constexpr double kSmallestDeviation = 0.0017;
// Smallest standard deviation of the predicted outline [rad]: 4 px of an image with 640 x 480 pixels.
constexpr double kOutlineDeviation = 0.0065;
// Step of depth between neighbouring cells, relative to the prediction, that is usual on one surface [m].
constexpr double kUsualStep = 0.003;
// Smallest distance along the normal per distance along the ray: steeper sides are hardly seen.
constexpr double kSteepest = 0.05;
// Iterations; then the probabilities hardly change.
constexpr int kIterations = 8;

/// Differences of the cells' depth without the median of their piece: what a whole piece does is no
/// occluder's doing.
class Excess {
 public:
  Excess(const SurfaceSamples& samples, const LabelCells& cells) : samples_(samples) {
    std::map<std::uint32_t, std::vector<double>> differences;
    for (const LabelCell& cell : cells.cells)
      if (cell.shows_front && cell.onSurface() && cell.body > 0.5f)
        differences[pieceOf(cell)].push_back(cell.difference);
    for (auto& [piece, values] : differences) medians_[piece] = median(&values);
    std::vector<double> deviations;
    for (const LabelCell& cell : cells.cells)
      if (cell.shows_front && cell.onSurface() && cell.body > 0.5f)
        deviations.push_back(std::abs(of(cell)) * facing(cell));
    deviation_ = std::hypot(kSmallestDeviation, median(&deviations) / kMedianPerSigma);
  }

  double of(const LabelCell& cell) const {
    const auto found = medians_.find(pieceOf(cell));
    return cell.difference - (found == medians_.end() ? 0.0 : found->second);
  }
  /// Standard deviation on the body [m]. It is the same everywhere along the normal, so depth is less certain
  /// on a steep side.
  double deviation(const LabelCell& cell) const { return deviation_ / facing(cell); }

 private:
  const SurfaceSample& sampleOf(const LabelCell& cell) const {
    return samples_.samples[static_cast<std::size_t>(cell.sample)];
  }
  /// Distance along the normal per distance along the ray.
  double facing(const LabelCell& cell) const {
    const SurfaceSample& sample = sampleOf(cell);
    return std::max(kSteepest, -sample.normal.dot(sample.position) / sample.position.z());
  }
  std::uint32_t pieceOf(const LabelCell& cell) const { return sampleOf(cell).piece; }

  const SurfaceSamples& samples_;
  std::map<std::uint32_t, double> medians_;
  double deviation_ = 0.0;
};

/// Log odds of a cell by itself. What is nearer than the body can be is as surely an occluder as at this
/// distance. Beside the predicted outline the body is less likely, and its depth less certain: the surface
/// may go on at any slope up to 45 degrees.
double ownLogOdds(const LabelCell& cell, const Excess& excess, const LabelPrior& prior, int size_px) {
  const double per_px = cell.predicted / prior.focal_px;
  const double beside_m = cell.distance * size_px * per_px;
  const double outside = beside_m / (prior.error_m + kOutlineDeviation * cell.predicted);
  return kPredicted - 0.5 * outside * outside + cell.color_odds +
         DepthEvidence::logOddsBeforeBody(std::max(excess.of(cell), -kReach_m),
                                          std::hypot(excess.deviation(cell), beside_m));
}

/// How strongly neighbouring cells are alike.
double coupling(double step_m) {
  const double ratio = step_m / kUsualStep;
  return std::exp(-0.5 * ratio * ratio);
}

/// The cells as a field: sums of log odds, and the couplings to the right and downwards.
struct Field {
  std::vector<double> own, right, down, mean;
};

Field makeField(const Excess& excess, const LabelPrior& prior, const LabelCells& cells) {
  const std::size_t count = cells.cells.size(), width = static_cast<std::size_t>(cells.grid.width);
  Field field{std::vector<double>(count), std::vector<double>(count), std::vector<double>(count),
              std::vector<double>(count)};
  const LabelRecall recall(prior.last, prior.reach_px);
  for (std::size_t i = 0; i < count; ++i) {
    const LabelCell& cell = cells.cells[i];
    if (!cell.shows_front) continue;
    const cv::Point place(static_cast<int>(i % width), static_cast<int>(i / width));
    const cv::Rect pixels = cells.pixels(place);
    field.own[i] = ownLogOdds(cell, excess, prior, cells.size_px) +
                   recall.logOdds((pixels.tl() + pixels.br()) / 2, cell.measured());
    const auto alike = [&](std::size_t j) {
      return cells.cells[j].shows_front ? coupling(excess.of(cell) - excess.of(cells.cells[j])) : 0.0;
    };
    if ((i + 1) % width != 0) field.right[i] = alike(i + 1);
    if (i + width < count) field.down[i] = alike(i + width);
  }
  return field;
}

void markNeighbors(LabelCells* cells) {
  for (cv::Point place(0, 0); place.y < cells->grid.height; ++place.y) {
    for (place.x = 0; place.x < cells->grid.width; ++place.x) {
      if (!cells->at(place).showsOccluder()) continue;
      const cv::Rect around = cv::Rect(place - cv::Point(1, 1), cv::Size(3, 3)) & cv::Rect({}, cells->grid);
      for (int row = around.y; row < around.br().y; ++row)
        for (int column = around.x; column < around.br().x; ++column)
          cells->at({column, row}).beside_occluder = true;
    }
  }
}

/// Joins the occluders' cells, without a step in depth between them, to those before the body. Beside the
/// body something nearer may as well be the table.
void joinOccluders(LabelCells* cells) {
  std::vector<cv::Point> reached;
  for (cv::Point place(0, 0); place.y < cells->grid.height; ++place.y) {
    for (place.x = 0; place.x < cells->grid.width; ++place.x) {
      LabelCell& cell = cells->at(place);
      cell.joined = cell.onSurface() && cell.showsOccluder();
      if (cell.joined) reached.push_back(place);
    }
  }
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const float depth = cells->at(reached[i]).measured();
    for (const cv::Point& step : {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
      const cv::Point place = reached[i] + step;
      if (!cells->contains(place)) continue;
      LabelCell& next = cells->at(place);
      if (next.joined || !next.showsOccluder() || std::abs(next.measured() - depth) > kSurfaceEnds) continue;
      next.joined = true;
      reached.push_back(place);
    }
  }
}

}  // namespace

void tellOccluders(const SurfaceSamples& samples, const LabelPrior& prior, LabelCells* cells) {
  const Excess excess(samples, *cells);
  Field field = makeField(excess, prior, *cells);
  const std::size_t count = field.own.size(), width = static_cast<std::size_t>(cells->grid.width);
  std::vector<double> log_odds = field.own;
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    for (std::size_t i = 0; i < count; ++i) field.mean[i] = std::tanh(0.5 * log_odds[i]);
    for (std::size_t i = 0; i < count; ++i) {
      if (!cells->cells[i].shows_front) continue;
      double sum = field.own[i] + field.right[i] * (i + 1 < count ? field.mean[i + 1] : 0.0) +
                   field.down[i] * (i + width < count ? field.mean[i + width] : 0.0);
      if (i > 0) sum += field.right[i - 1] * field.mean[i - 1];
      if (i >= width) sum += field.down[i - width] * field.mean[i - width];
      log_odds[i] = sum;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    LabelCell& cell = cells->cells[i];
    if (cell.shows_front) cell.shift = cell.difference - static_cast<float>(excess.of(cell));
    cell.body = static_cast<float>(0.5 + 0.5 * std::tanh(0.5 * log_odds[i]));
  }
  markNeighbors(cells);
  joinOccluders(cells);
}

}  // namespace softbody
