#include "softbody_sim/identification/shape_fit.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "identification/material_fit.h"
#include "identification/surface_points.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

/// More points tell no more: their errors are those of their neighbours.
constexpr Eigen::Index kMostPoints = 6000;

Points thinned(const Points& points) {
  const Eigen::Index step = (points.rows() + kMostPoints - 1) / kMostPoints;
  if (step <= 1) return points;
  Points fewer((points.rows() + step - 1) / step, 3);
  for (Eigen::Index k = 0; k < fewer.rows(); ++k) fewer.row(k) = points.row(k * step);
  return fewer;
}

double diagonalOf(const Points& points) {
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

/// The middle of the points must be near the body, and their size like the body's.
void requireNear(const Points& measured, const Points& rest) {
  if (measured.rows() < 50)
    throw std::invalid_argument(
        fmt::format("the measured shape has {} points; at least 50 are needed", measured.rows()));
  if (!measured.allFinite()) throw std::invalid_argument("the measured shape has a point that is not finite");
  const double size = diagonalOf(rest), of_measured = diagonalOf(measured);
  if (of_measured > 3.0 * size || of_measured < 0.2 * size)
    throw std::invalid_argument(fmt::format(
        "the measured shape is {:.3g} m large, the object {:.3g} m: check the unit, and leave out what "
        "does not belong to the object",
        of_measured, size));
  const double away = (measured.colwise().mean() - rest.colwise().mean()).norm();
  if (away > size)
    throw std::invalid_argument(fmt::format(
        "the measured shape is {:.3g} m away from the object at rest: give it in the object's frame, so "
        "that the held part lies on the object's",
        away));
}

/// Where the points belong, once the material is found. @param problem its targets are set.
void associate(const SurfacePoints& surface, const Points& measured, MaterialProblem problem,
               const std::function<void(double)>& progress, std::vector<Target>* targets) {
  constexpr int kAlignments = 8, kRounds = 40;  // small motions first; a bound: a small change ends it
  if (std::isfinite(problem.mass_std)) problem.mass_std = 0.0;  // its deviation counts at the end
  const std::vector<Unknown> unknowns = unknownsOf(problem);
  Points shape = ForwardModel(problem).predict(problem.prior).shapes.front();
  for (int round = 0; round < kRounds; ++round) {
    progress(static_cast<double>(round) / kRounds);
    // The rigid motion first, so that the material does not bend the body to where it has to be turned.
    const bool is_alignment = round < kAlignments;
    problem.observations[0].targets = surface.targetsOf(measured, shape);
    MaterialFit fit(problem, is_alignment ? std::vector<Unknown>() : unknowns);
    fit.run([](double) {});
    if (!is_alignment) problem.prior = fit.material();
    const Points next = transformed(fit.state().prediction.shapes.front(), fit.state().alignment);
    const double change = (next - shape).rowwise().norm().maxCoeff();
    shape = next;
    if (!is_alignment && change < 1e-5 * diagonalOf(shape)) break;
  }
  *targets = surface.targetsOf(measured, shape);
}

}  // namespace

MaterialEstimate identifyFromShape(MaterialProblem problem, const MeshTopology& visual, const Points& given,
                                   const std::function<void(double)>& progress,
                                   std::vector<Target>* targets) {
  if (problem.observations.size() != 1)
    throw std::invalid_argument("a shape is one observation of the surroundings");
  const Points measured = thinned(given);
  requireNear(measured, transformed(problem.topology.rest_vertices, problem.body_pose));
  const SurfacePoints surface(visual, problem.topology);
  std::vector<Target>& found = problem.observations[0].targets;
  associate(
      surface, measured, problem, [&progress](double share) { progress(0.7 * share); }, &found);
  const MaterialEstimate estimate =
      identifyMaterial(problem, [&progress](double share) { progress(0.7 + 0.3 * share); });
  if (targets != nullptr) *targets = found;
  return estimate;
}

}  // namespace softbody
