#include "alignment/rigid_alignment.h"

#include "alignment/shown_pieces.h"

namespace softbody {
namespace {

constexpr int kIterations = 5;
constexpr std::size_t kEnoughFeatures = 300;
constexpr int kPixelStep = 2;              // six numbers need no more of the thousands of pixels
constexpr double kConvergence = 3e-4;      // [m]
constexpr double kHeldShare = 0.15;        // of what measurements weigh
constexpr double kLargestRigidStep = 0.1;  // [m] of any vertex; more is no tracking

void addAcrossRay(const Association& feature, std::vector<Association>* associations) {
  const Eigen::Vector3d ray = feature.measured.normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(ray).normalized();
  for (const Eigen::Vector3d& normal : {right, Eigen::Vector3d(ray.cross(right))}) {
    associations->push_back(feature);
    associations->back().normal = normal;
  }
}

/// @param step 1: all; 2: every second match, and so on, with the weight of those left out.
void addInliers(const std::vector<FeatureMatch>& matches, std::size_t step,
                std::vector<Association>* associations) {
  for (std::size_t m = 0; m < matches.size(); m += step) {
    if (!matches[m].inlier) continue;
    Association feature = matches[m].association;
    feature.weight *= static_cast<double>(step);
    addAcrossRay(feature, associations);
  }
}

}  // namespace

std::vector<Association> inliers(const std::vector<FeatureMatch>& matches) {
  std::vector<Association> result;
  result.reserve(2 * matches.size());
  addInliers(matches, 1, &result);
  return result;
}

std::vector<Association> heldBack(const Points& piece, const Eigen::Isometry3d& motion,
                                  const AssociationRefs& measured) {
  double weight = 0.0;
  for (const Association* association : measured) weight += association->weight;
  std::vector<Association> held;
  for (const auto& vertex : piece.rowwise()) {
    Association association;
    association.measured = vertex;
    association.predicted = motion * association.measured;
    association.weight = kHeldShare * weight / static_cast<double>(piece.rows());
    held.push_back(association);
  }
  return held;
}

double largestMotion(const PredictedSurface& surface, const RigidMotions& motions) {
  return (surface.movedVolume(motions) - surface.volumeVertices()).rowwise().norm().maxCoeff();
}

void RigidAlignment::gather(const DepthAssociations& depth, const RigidMotions& motions) {
  of_body_.resize(motions.size());
  for (auto& associations : of_body_) associations.clear();
  for (const Association& association : depth.associations)
    of_body_[association.body].push_back(&association);
  for (std::size_t f = 0; f < features_.size(); ++f) {
    moved_[f].predicted = motions[features_[f].body] * features_[f].predicted;
    of_body_[moved_[f].body].push_back(&moved_[f]);
  }
}

RigidMotions RigidAlignment::align(const RgbdFrame& frame, const PredictedSurface& surface,
                                   const SurfaceSamples& samples, const ColorModel& colors,
                                   const std::vector<FeatureMatch>& matches, DepthAssociator* depth) {
  RigidMotions motions(surface.pieceCount(), Eigen::Isometry3d::Identity());
  const std::vector<Points> pieces = surface.pieceVertices();
  features_.clear();
  addInliers(matches, 1 + matches.size() / kEnoughFeatures, &features_);
  moved_ = features_;
  for (int i = 0; i < kIterations; ++i) {
    const DepthAssociations& seen =
        depth->associate(frame, surface.image(), samples, motions, colors, kPixelStep);
    gather(seen, motions);
    const std::vector<Shows> shown = shownPieces(samples, seen.associations, matches, pieces);
    RigidMotions before = motions;
    for (std::size_t body = 0; body < motions.size(); ++body) {
      if (shown[body] == Shows::kHardly || static_cast<int>(of_body_[body].size()) < kFewestAssociations)
        continue;
      std::vector<Association> held;
      if (shown[body] == Shows::kLoosely) held = heldBack(pieces[body], motions[body], of_body_[body]);
      motions[body] = rigidStep(of_body_[body], held) * motions[body];
    }
    const double moved =
        (surface.movedVolume(motions) - surface.movedVolume(before)).rowwise().norm().maxCoeff();
    if (moved > kLargestRigidStep) return before;
    if (moved < kConvergence) break;
  }
  return motions;
}

}  // namespace softbody
