#include "softbody_evaluation/models/model_distance.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "measures/corner_weights.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_evaluation/measures/surface_samples.h"
#include "softbody_evaluation/measures/volume.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody::evaluation {
namespace {

constexpr std::size_t kSamples = 50000;  // of each surface: shares are known to 0.2 %
constexpr double kMeasured = 0.5;        // from this value of `seen` on
constexpr double kSamePlace_m = 0.005;   // farther apart, colours are not of one place

/// A place of one surface and the nearest one of the other.
struct PlacePair {
  float distance;  ///< [m]
  bool seen;       ///< the scanned place was measured
};

bool wasSeen(const Model& scanned, int triangle, const Eigen::Vector3d& weights) {
  return scanned.seen.empty() ||
         interpolated(scanned.seen, scanned.mesh.triangles, triangle, weights) >= kMeasured;
}

Eigen::Vector3d weightsAt(const TriangleMesh& mesh, const SurfacePoint& place) {
  const auto corners = mesh.triangles.row(place.triangle);
  return cornerWeights(mesh.vertices, {corners[0], corners[1], corners[2]}, place.position);
}

/// Colours of pairs of near places.
class ColorComparison {
 public:
  void add(const Eigen::Vector3d& scanned, const Eigen::Vector3d& truth) {
    if (!scanned.allFinite() || !truth.allFinite()) return;
    scanned_.push_back(scanned);
    true_.push_back(truth);
    products_ += scanned.cwiseProduct(truth);
    squares_ += truth.cwiseAbs2();
  }

  void report(ModelReport* report) const {
    if (scanned_.empty()) return;
    report->gain = products_.cwiseQuotient(squares_.cwiseMax(1.0));
    std::vector<float> differences;
    for (std::size_t i = 0; i < scanned_.size(); ++i)
      differences.push_back(
          static_cast<float>((scanned_[i] - report->gain.cwiseProduct(true_[i])).cwiseAbs().mean()));
    report->color = summarize(std::move(differences));
  }

 private:
  std::vector<Eigen::Vector3d> scanned_, true_;
  Eigen::Vector3d products_ = Eigen::Vector3d::Zero(), squares_ = Eigen::Vector3d::Zero();
};

/// Pairs from the scanned surface to the true one. Colours count where the scan was measured.
std::vector<PlacePair> pairsToTruth(const Model& scanned, const Model& truth, std::uint64_t seed,
                                    ColorComparison* colors) {
  const ClosestPointQuery query(truth.mesh.vertices, truth.mesh.triangles);
  std::vector<PlacePair> pairs;
  for (const SurfaceSample& sample : sampleSurface(scanned.mesh, kSamples, seed)) {
    const SurfacePoint nearest = query.closest(sample.position);
    const double distance = (nearest.position - sample.position).norm();
    pairs.push_back({static_cast<float>(distance), wasSeen(scanned, sample.triangle, sample.weights)});
    if (!pairs.back().seen || distance > kSamePlace_m) continue;
    colors->add(colorAt(scanned, sample.triangle, sample.weights),
                colorAt(truth, nearest.triangle, weightsAt(truth.mesh, nearest)));
  }
  return pairs;
}

std::vector<PlacePair> pairsToScanned(const Model& scanned, const Model& truth, std::uint64_t seed) {
  const ClosestPointQuery query(scanned.mesh.vertices, scanned.mesh.triangles);
  std::vector<PlacePair> pairs;
  for (const SurfaceSample& sample : sampleSurface(truth.mesh, kSamples, seed)) {
    const SurfacePoint nearest = query.closest(sample.position);
    pairs.push_back({static_cast<float>((nearest.position - sample.position).norm()),
                     wasSeen(scanned, nearest.triangle, weightsAt(scanned.mesh, nearest))});
  }
  return pairs;
}

template <typename Counts>
std::vector<float> distancesOf(const std::vector<PlacePair>& pairs, const Counts& counts) {
  std::vector<float> distances;
  for (const PlacePair& pair : pairs) {
    if (counts(pair)) distances.push_back(pair.distance);
  }
  return distances;
}

template <typename Counts>
SurfaceAgreement agreement(const std::vector<PlacePair>& to_truth, const std::vector<PlacePair>& to_scanned,
                           const Counts& counts) {
  SurfaceAgreement result;
  const std::vector<float> there = distancesOf(to_truth, counts), back = distancesOf(to_scanned, counts);
  result.share = static_cast<double>(there.size()) / static_cast<double>(to_truth.size());
  result.to_truth = summarize(there);
  result.to_scanned = summarize(back);
  result.within_1mm = shareWithin(back, 0.001);
  result.within_2mm = shareWithin(back, 0.002);
  return result;
}

std::optional<double> volumeOf(const TriangleMesh& mesh) {
  if (!isClosed(mesh.vertices, mesh.triangles)) return std::nullopt;
  return enclosedVolume(mesh.vertices, mesh.triangles);
}

}  // namespace

ModelReport compareModels(const Model& scanned, const Model& truth, const Eigen::Isometry3d& T_true_scanned,
                          std::uint64_t seed) {
  Model moved = scanned;
  moved.mesh.vertices = transformed(scanned.mesh.vertices, T_true_scanned);
  ColorComparison colors;
  const std::vector<PlacePair> to_truth = pairsToTruth(moved, truth, seed, &colors);
  const std::vector<PlacePair> to_scanned = pairsToScanned(moved, truth, seed);
  ModelReport report;
  report.T_true_scanned = T_true_scanned;
  report.whole = agreement(to_truth, to_scanned, [](const PlacePair&) { return true; });
  if (!scanned.seen.empty()) {
    report.seen = agreement(to_truth, to_scanned, [](const PlacePair& pair) { return pair.seen; });
    report.unseen = agreement(to_truth, to_scanned, [](const PlacePair& pair) { return !pair.seen; });
  }
  report.scanned_m3 = volumeOf(scanned.mesh);
  report.true_m3 = volumeOf(truth.mesh);
  colors.report(&report);
  return report;
}

}  // namespace softbody::evaluation
