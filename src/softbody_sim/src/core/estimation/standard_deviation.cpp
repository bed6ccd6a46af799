#include "estimation/standard_deviation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "estimation/target_residual.h"

namespace softbody {
namespace {

/// What the targets differ from the body by.
struct Misfit {
  Points around;                ///< per vertex: weighted mean of the residuals [m]
  double mean_square_m2 = 0.0;  ///< of all residuals, in one direction
};

Misfit misfitOf(const std::vector<Target>& targets, const Tets& tets, const Points& vertices) {
  Misfit misfit{Points::Zero(vertices.rows(), 3)};
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(vertices.rows());
  double directions = 0.0;
  for (const Target& target : targets) {
    if (target.kind == TargetKind::kPrior) continue;
    const Eigen::Vector3d residual = residualOf(target, tets, vertices);
    misfit.mean_square_m2 += target.weight * residual.squaredNorm();
    directions += target.weight * (target.normal.isZero() ? 3.0 : 1.0);
    for (int k = 0; k < 4; ++k) {
      const double weight = target.weight * std::max(0.0, target.place.barycentric[k]);
      misfit.around.row(tets(target.place.tet, k)) += weight * residual.transpose();
      weights[tets(target.place.tet, k)] += weight;
    }
  }
  if (directions > 0.0) misfit.mean_square_m2 /= directions;
  for (Eigen::Index v = 0; v < weights.size(); ++v)
    if (weights[v] > 0.0) misfit.around.row(v) /= weights[v];
  return misfit;
}

}  // namespace

void standardDeviations(const std::vector<Target>& targets, const Tets& tets, const Points& vertices,
                        const ShapePosterior& posterior, std::vector<float>* deviations) {
  constexpr double kDirections = 3.0;
  const Misfit misfit = misfitOf(targets, tets, vertices);
  deviations->resize(static_cast<std::size_t>(vertices.rows()));
  for (const ShapePosterior::Piece& piece : posterior.pieces) {
    const Eigen::VectorXf along = squaredRowNorms(*piece.motions, piece.root);  // variance along each axis
    for (std::size_t k = 0; k < piece.vertices->size(); ++k) {
      const int v = (*piece.vertices)[k];
      const double variance = along.segment<3>(3 * static_cast<Eigen::Index>(k)).sum() +
                              misfit.around.row(v).squaredNorm() + kDirections * misfit.mean_square_m2;
      (*deviations)[static_cast<std::size_t>(v)] =
          static_cast<float>(std::min(std::sqrt(variance), ShapePosterior::kUnknown_m));
    }
  }
}

void fadeUnobserved(double elapsed_s, MeshState* state) {
  constexpr double kHalfLife_s = 0.5;  // hands deform a body within about a second
  const auto fade = static_cast<float>(std::pow(0.5, elapsed_s / kHalfLife_s));
  for (float& confidence : state->confidence) confidence *= fade;
  // The variance goes to that of a vertex of which nothing is known.
  constexpr float kUnknown = ShapePosterior::kUnknown_m * ShapePosterior::kUnknown_m;
  for (float& deviation : state->standard_deviation)
    deviation = std::sqrt(fade * deviation * deviation + (1.0f - fade) * kUnknown);
}

}  // namespace softbody
