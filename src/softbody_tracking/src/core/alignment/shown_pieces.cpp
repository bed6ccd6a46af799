#include "alignment/shown_pieces.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace softbody {
namespace {

constexpr int kFewest = 12;          // features, or blocks of depth
constexpr int kEnough = 150;         // blocks of depth, whatever is hidden beside them
constexpr double kLeastShown = 0.3;  // of the blocks that the prediction shows of a piece
// Times the error of a block of depth, anywhere on the piece.
constexpr double kLoose = 1.0, kMostUnsure = 2.0;
constexpr double kConfirmed = 0.9;  // of the blocks
constexpr double kPrecision = 3.0;  // of a feature, times that of a block

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// What a frame says of a piece, and of its rigid motion about its centre: the inverse of the covariance
/// where every block of depth errs by 1.
struct Evidence {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  int blocks = 0, agreeing = 0, features = 0;
  Matrix6d information = Matrix6d::Zero();

  void addDepth(const Association& a) {
    ++agreeing;
    const Eigen::Matrix<double, 6, 1> row = motionJacobian(a.predicted - center).transpose() * a.normal;
    information += row * row.transpose();
  }
  /// Across its ray only.
  void addFeature(const Association& a) {
    ++features;
    const Eigen::Matrix<double, 3, 6> J = motionJacobian(a.predicted - center);
    const Eigen::Vector3d ray = a.predicted.normalized();
    information +=
        kPrecision * kPrecision * J.transpose() * (Eigen::Matrix3d::Identity() - ray * ray.transpose()) * J;
  }
};

/// Standard deviation of where it is fixed least; infinite where some motion is not fixed at all.
double largestError(const Evidence& evidence, const Points& points) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(evidence.information);
  const Eigen::Matrix<double, 6, 1>& values = eigen.eigenvalues();
  if (!(values[0] > 1e-9 * values[5])) return std::numeric_limits<double>::infinity();
  const Matrix6d root = eigen.eigenvectors() * values.cwiseSqrt().cwiseInverse().asDiagonal();
  double largest = 0.0;
  for (const auto& point : points.rowwise())
    largest = std::max(largest, (motionJacobian(point.transpose() - evidence.center) * root).squaredNorm());
  return std::sqrt(largest);
}

Shows judge(const Evidence& evidence, const Points& points) {
  if (evidence.agreeing >= kEnough) return Shows::kWell;
  const bool shows = evidence.features >= kFewest ||
                     (evidence.agreeing >= kFewest && evidence.agreeing >= kLeastShown * evidence.blocks);
  const double error = shows ? largestError(evidence, points) : kMostUnsure;
  return error >= kMostUnsure ? Shows::kHardly : error >= kLoose ? Shows::kLoosely : Shows::kWell;
}

}  // namespace

std::vector<Shows> shownPieces(const SurfaceSamples& samples, const std::vector<Association>& depth,
                               const std::vector<FeatureMatch>& matches, const std::vector<Points>& pieces) {
  if (pieces.size() == 1) return {Shows::kWell};
  std::vector<Evidence> evidence(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) evidence[p].center = pieces[p].colwise().mean();
  for (const SurfaceSample& sample : samples.samples) ++evidence[sample.body].blocks;
  for (const Association& association : depth) evidence[association.body].addDepth(association);
  for (const FeatureMatch& match : matches) {
    if (match.inlier) evidence[match.association.body].addFeature(match.association);
  }
  std::vector<Shows> shown;
  shown.reserve(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) shown.push_back(judge(evidence[p], pieces[p]));
  return shown;
}

std::vector<bool> predictedPieces(const SurfaceSamples& samples, std::size_t piece_count) {
  std::vector<int> blocks(piece_count, 0);
  for (const SurfaceSample& sample : samples.samples) ++blocks[sample.body];
  std::vector<bool> predicted;
  predicted.reserve(piece_count);
  for (const int count : blocks) predicted.push_back(count >= kFewest);
  return predicted;
}

std::vector<bool> confirmedPieces(const SurfaceSamples& samples, const std::vector<Association>& depth,
                                  std::size_t piece_count) {
  std::vector<int> blocks(piece_count, 0), agreeing(piece_count, 0);
  for (const SurfaceSample& sample : samples.samples) ++blocks[sample.body];
  for (const Association& association : depth) ++agreeing[association.body];
  std::vector<bool> confirmed;
  for (std::size_t p = 0; p < piece_count; ++p)
    confirmed.push_back(agreeing[p] >= kFewest && agreeing[p] >= kConfirmed * blocks[p]);
  return confirmed;
}

}  // namespace softbody
