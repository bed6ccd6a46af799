#include "alignment/rigid_alignment.h"

#include "alignment/piece_visibility.h"

namespace softbody {
namespace {

// Iterations of the ICP; from one frame to the next it converges in two or three.
constexpr int kIterations = 5;
// Features used for the motion; more would only cost time.
constexpr std::size_t kEnoughFeatures = 300;
// Every second pixel of a block in both directions: six numbers need no more of the thousands of pixels.
constexpr int kPixelStep = 2;
// Motion of the fastest vertex [m] at which the ICP ends; below the depth noise.
constexpr double kConvergence = 3e-4;
// Weight that holds a partly visible piece back, as a share of the weight of its measurements.
constexpr double kHeldShare = 0.15;

/// Associations by the piece that they measure.
using AssociationsByPiece = std::vector<AssociationRefs>;

void addAcrossRay(const Association& feature, std::vector<Association>* associations) {
  const Eigen::Vector3d ray = feature.measured.normalized();
  const Eigen::Vector3d right = Eigen::Vector3d::UnitY().cross(ray).normalized();
  for (const Eigen::Vector3d& normal : {right, Eigen::Vector3d(ray.cross(right))}) {
    associations->push_back(feature);
    associations->back().normal = normal;
  }
}

/// @param step 1: all; 2: every second match with twice the weight, and so on.
void addInliers(const std::vector<FeatureMatch>& matches, std::size_t step,
                std::vector<Association>* associations) {
  for (std::size_t m = 0; m < matches.size(); m += step) {
    if (!matches[m].inlier) continue;
    Association feature = matches[m].association;
    feature.weight *= static_cast<double>(step);
    addAcrossRay(feature, associations);
  }
}

/// With their predicted positions after the motions.
std::vector<Association> moved(const RigidMotions& motions, std::vector<Association> associations) {
  for (Association& a : associations) a.predicted = motions[a.piece] * a.predicted;
  return associations;
}

AssociationsByPiece gather(const std::vector<Association>& depth, const std::vector<Association>& features,
                           const std::vector<Association>& outline, std::size_t piece_count) {
  AssociationsByPiece result(piece_count);
  for (const std::vector<Association>* all : {&depth, &features, &outline})
    for (const Association& association : *all) result[association.piece].push_back(&association);
  return result;
}

/// One ICP step of every piece that is not almost hidden.
RigidMotions steppedMotions(const RigidMotions& motions, const std::vector<Points>& pieces,
                            const std::vector<Visibility>& visibility, const AssociationsByPiece& measured) {
  RigidMotions result = motions;
  for (std::size_t piece = 0; piece < motions.size(); ++piece) {
    if (visibility[piece] == Visibility::kAlmostHidden) continue;
    if (static_cast<int>(measured[piece].size()) < kFewestAssociations) continue;
    std::vector<Association> held;
    if (visibility[piece] == Visibility::kPartly)
      held = heldBack(pieces[piece], motions[piece], measured[piece]);
    result[piece] = rigidStep(measured[piece], held) * motions[piece];
  }
  return result;
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

RigidMotions alignRigidly(const RgbdFrame& frame, const View& view, const Labels& labels,
                          const std::vector<FeatureMatch>& matches, const MeasurementWeights& weights) {
  const PredictedSurface& surface = view.surface;
  RigidMotions motions(surface.pieceCount(), Eigen::Isometry3d::Identity());
  const std::vector<Points> pieces = surface.pieceVertices();
  const std::vector<Association> contours = contoursOf(frame, view, motions, labels, weights).associations;
  std::vector<Association> features;
  addInliers(matches, 1 + matches.size() / kEnoughFeatures, &features);
  for (int i = 0; i < kIterations; ++i) {
    const DepthAssociations seen = depthOf(frame, view, motions, labels, weights, kPixelStep);
    const std::vector<Association> moved_features = moved(motions, features);
    std::vector<Association> moved_contours = moved(motions, contours);
    weighByResidual(kRobustScale, &moved_contours);
    const AssociationsByPiece measured =
        gather(seen.associations, moved_features, moved_contours, motions.size());
    const RigidMotions next = steppedMotions(
        motions, pieces, pieceVisibility(view.samples, seen.associations, matches, pieces), measured);
    const double step_m =
        (surface.movedVolume(next) - surface.movedVolume(motions)).rowwise().norm().maxCoeff();
    motions = next;
    if (step_m < kConvergence) break;
  }
  return motions;
}

}  // namespace softbody
