#include "features/feature_recognition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "features/descriptor_match.h"
#include "features/feature_matching.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

// RANSAC trials; most end at the first edge whose lengths differ, so they are cheap.
constexpr int kTrials = 3000;
// Refits of the best motion to the pairs that agree with it.
constexpr int kRecognitionFits = 3;
// Shortest edge of a trial's triangle, in tolerances; a smaller triangle does not fix the rotation.
constexpr double kShortestEdge = 4.0;
// Pairs that must agree, plus one for each kPairsPerChance pairs: among more pairs, more agree by chance.
constexpr std::size_t kFewestAgreeing = 15, kPairsPerChance = 50;
// Deformation of a piece, as a share of its diameter, with which it is still recognised.
constexpr double kDeformation = 0.03;
// Smallest tolerance [m]: the precision of depth.
constexpr double kDepthPrecision = 0.002;

/// For each keypoint, the feature whose nearest descriptor it has; null without one. There is no ratio test:
/// wrong pairs do not agree on one motion.
std::vector<const MapFeature*> ownersOf(const std::vector<Keypoint>& keypoints,
                                        const std::vector<MapFeature>& features) {
  std::vector<const MapFeature*> owners(keypoints.size(), nullptr);
  std::vector<int> owner_distances(keypoints.size());
  for (const MapFeature& feature : features) {
    std::size_t nearest = 0;
    int least = kMaxHammingDistance + 1;
    for (std::size_t k = 0; k < keypoints.size(); ++k) {
      const int distance = hammingDistance(feature.descriptor, keypoints[k].descriptor);
      if (distance >= least) continue;
      nearest = k;
      least = distance;
    }
    if (least > kMaxHammingDistance) continue;
    if (owners[nearest] != nullptr && owner_distances[nearest] <= least) continue;
    owners[nearest] = &feature;
    owner_distances[nearest] = least;
  }
  return owners;
}

using Triple = std::array<const PointPair*, 3>;

/// Whether three pairs form one rigid triangle that is large enough to fix its pose.
bool isTriangle(const Triple& triple, double tolerance) {
  for (int k = 0; k < 3; ++k) {
    const PointPair &a = *triple[k], &b = *triple[(k + 1) % 3];
    const double expected = (a.expected - b.expected).norm(), measured = (a.measured - b.measured).norm();
    if (expected < kShortestEdge * tolerance || std::abs(expected - measured) > tolerance) return false;
  }
  return true;
}

template <typename Pairs>
Eigen::Isometry3d fit(const Pairs& pairs) {
  Points expected(static_cast<Eigen::Index>(pairs.size()), 3), measured(expected.rows(), 3);
  Eigen::Index row = 0;
  for (const PointPair* pair : pairs) {
    expected.row(row) = pair->expected;
    measured.row(row++) = pair->measured;
  }
  return fitRigid(expected, measured);
}

std::vector<const PointPair*> agreeing(const std::vector<PointPair>& pairs, const Eigen::Isometry3d& motion,
                                       double tolerance) {
  std::vector<const PointPair*> result;
  for (const PointPair& pair : pairs) {
    if ((motion * pair.expected - pair.measured).squaredNorm() < tolerance * tolerance)
      result.push_back(&pair);
  }
  return result;
}

}  // namespace

std::vector<PointPair> recognizedFeatures(const RgbdFrame& frame, const std::vector<MapFeature>& features,
                                          const std::vector<Keypoint>& keypoints, const SurfaceModel& model,
                                          const Points& vertices) {
  std::vector<PointPair> pairs;
  const std::vector<const MapFeature*> owners = ownersOf(keypoints, features);
  for (std::size_t k = 0; k < keypoints.size(); ++k) {
    if (owners[k] == nullptr) continue;
    const cv::Point2f& pixel = keypoints[k].pixel;
    const double z = featureDepth(frame.depth, pixel);
    if (z <= 0.0) continue;
    const MaterialPoint& place = owners[k]->place;
    pairs.push_back({positionOf(place, vertices, model.volume().tets),
                     frame.camera.unproject(pixel.x, pixel.y, z), model.pieceOf(place)});
  }
  return pairs;
}

double recognitionTolerance(const Points& rest_vertices) {
  const Eigen::Vector3d size = rest_vertices.colwise().maxCoeff() - rest_vertices.colwise().minCoeff();
  return std::max(kDeformation * size.norm(), kDepthPrecision);
}

std::optional<Eigen::Isometry3d> recognizedMotion(const std::vector<PointPair>& pairs, double tolerance_m) {
  const std::size_t fewest = kFewestAgreeing + pairs.size() / kPairsPerChance;
  if (pairs.size() < fewest) return std::nullopt;
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> pick(0, pairs.size() - 1);
  std::vector<const PointPair*> most;
  for (int trial = 0; trial < kTrials; ++trial) {
    const Triple triple{&pairs[pick(random)], &pairs[pick(random)], &pairs[pick(random)]};
    if (!isTriangle(triple, tolerance_m)) continue;
    std::vector<const PointPair*> others = agreeing(pairs, fit(triple), tolerance_m);
    if (others.size() > most.size()) most = std::move(others);
  }
  for (int i = 0; i < kRecognitionFits && most.size() >= fewest; ++i)
    most = agreeing(pairs, fit(most), tolerance_m);
  if (most.size() < fewest) return std::nullopt;
  return fit(most);
}

std::vector<Points> recognizedPieces(const std::vector<PointPair>& pairs, const PredictedSurface& surface,
                                     const std::vector<bool>& wanted, double min_motion_m) {
  std::vector<std::vector<PointPair>> of_piece(wanted.size());
  for (const PointPair& pair : pairs) of_piece[pair.piece].push_back(pair);
  std::vector<Points> found(wanted.size());
  for (std::size_t piece = 0; piece < wanted.size(); ++piece) {
    if (!wanted[piece]) continue;
    const std::vector<int>& vertices = surface.model().pieces()[piece];
    const Points rest = surface.volume().rest_vertices(vertices, Eigen::all);
    const auto motion = recognizedMotion(of_piece[piece], recognitionTolerance(rest));
    if (!motion) continue;
    const Points expected = surface.volumeVertices()(vertices, Eigen::all),
                 there = transformed(expected, *motion);
    if ((there - expected).rowwise().norm().maxCoeff() > min_motion_m) found[piece] = there;
  }
  return found;
}

}  // namespace softbody
