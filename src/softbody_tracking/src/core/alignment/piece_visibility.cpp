#include "alignment/piece_visibility.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "softbody_common/geometry/rigid_motion.h"

namespace softbody {
namespace {

// Blocks of depth that suffice, whatever part of the piece is occluded.
constexpr int kEnough = 150;
// Share of a piece's visible blocks that must agree; a rim beside the blade is less.
constexpr double kLeastShown = 0.3;
// Largest error of a vertex, in errors of one block of depth, of a piece that is well or partly visible.
constexpr double kWellError = 1.0, kPartlyError = 2.0;
// Share of the visible blocks that must agree before new features are learned.
constexpr double kConfirmed = 0.9;
// Precision of a feature across its ray, relative to that of a block of depth.
constexpr double kPrecision = 3.0;
// Ratio of eigenvalues below which a motion counts as undetermined; smaller ones are rounding.
constexpr double kSingular = 1e-9;

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// The measurements of a piece, and their information on its rigid motion about its centre: the inverse of
/// the covariance if every block of depth has the standard deviation 1.
struct Evidence {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  int blocks = 0, agreeing = 0, features = 0;
  Matrix6d information = Matrix6d::Zero();

  void addDepth(const Association& a) {
    ++agreeing;
    const Eigen::Matrix<double, 6, 1> row = motionJacobian(a.predicted - center).transpose() * a.normal;
    information += row * row.transpose();
  }
  /// A feature fixes the position across its ray only.
  void addFeature(const Association& a) {
    ++features;
    const Eigen::Matrix<double, 3, 6> J = motionJacobian(a.predicted - center);
    const Eigen::Vector3d ray = a.predicted.normalized();
    information +=
        kPrecision * kPrecision * J.transpose() * (Eigen::Matrix3d::Identity() - ray * ray.transpose()) * J;
  }
};

/// Largest standard deviation of a vertex; infinite if some motion is undetermined.
double largestError(const Evidence& evidence, const Points& points) {
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(evidence.information);
  const Eigen::Matrix<double, 6, 1>& values = eigen.eigenvalues();
  if (!(values[0] > kSingular * values[5])) return std::numeric_limits<double>::infinity();
  const Matrix6d root = eigen.eigenvectors() * values.cwiseSqrt().cwiseInverse().asDiagonal();
  double largest = 0.0;
  for (const auto& point : points.rowwise())
    largest = std::max(largest, (motionJacobian(point.transpose() - evidence.center) * root).squaredNorm());
  return std::sqrt(largest);
}

Visibility visibilityOf(const Evidence& evidence, const Points& points) {
  if (evidence.agreeing >= kEnough) return Visibility::kWell;
  const bool judgeable =
      evidence.features >= kFewestAssociations ||
      (evidence.agreeing >= kFewestAssociations && evidence.agreeing >= kLeastShown * evidence.blocks);
  const double error = judgeable ? largestError(evidence, points) : kPartlyError;
  if (error >= kPartlyError) return Visibility::kAlmostHidden;
  return error >= kWellError ? Visibility::kPartly : Visibility::kWell;
}

}  // namespace

std::vector<Visibility> pieceVisibility(const SurfaceSamples& samples, const std::vector<Association>& depth,
                                        const std::vector<FeatureMatch>& matches,
                                        const std::vector<Points>& pieces) {
  if (pieces.size() == 1) return {Visibility::kWell};
  std::vector<Evidence> evidence(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) evidence[p].center = pieces[p].colwise().mean();
  for (const SurfaceSample& sample : samples.samples) ++evidence[sample.piece].blocks;
  for (const Association& association : depth) evidence[association.piece].addDepth(association);
  for (const FeatureMatch& match : matches) {
    if (match.inlier) evidence[match.association.piece].addFeature(match.association);
  }
  std::vector<Visibility> result;
  result.reserve(pieces.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) result.push_back(visibilityOf(evidence[p], pieces[p]));
  return result;
}

std::vector<bool> piecesInView(const SurfaceSamples& samples, std::size_t piece_count) {
  std::vector<int> blocks(piece_count, 0);
  for (const SurfaceSample& sample : samples.samples) ++blocks[sample.piece];
  std::vector<bool> in_view;
  in_view.reserve(piece_count);
  for (const int count : blocks) in_view.push_back(count >= kFewestAssociations);
  return in_view;
}

std::vector<bool> confirmedPieces(const SurfaceSamples& samples, const std::vector<Association>& depth,
                                  std::size_t piece_count) {
  std::vector<int> blocks(piece_count, 0), agreeing(piece_count, 0);
  for (const SurfaceSample& sample : samples.samples) ++blocks[sample.piece];
  for (const Association& association : depth) ++agreeing[association.piece];
  std::vector<bool> confirmed;
  for (std::size_t p = 0; p < piece_count; ++p)
    confirmed.push_back(agreeing[p] >= kFewestAssociations && agreeing[p] >= kConfirmed * blocks[p]);
  return confirmed;
}

}  // namespace softbody
