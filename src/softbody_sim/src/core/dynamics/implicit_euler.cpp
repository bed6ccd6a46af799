#include "dynamics/implicit_euler.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "constraints/static_support.h"

namespace softbody {
namespace {

/// The frame interval of Material::damping. Also gives the inertia of a step without elapsed time.
constexpr double kNominalTimeStep = 1.0 / 30.0;  // [s]

/// Rounded to the microsecond. Frames at 30 Hz are 33,333,333 or 33,333,334 ns apart; rounding lets both
/// share one factorisation.
double timeStep(double elapsed_s) { return std::max(1.0, std::round(1e6 * elapsed_s)) * 1e-6; }

}  // namespace

void ImplicitEuler::step(BodyModel* model, const std::vector<Target>& targets, double elapsed_s,
                         const Surroundings& surroundings, BodyState* body) {
  const double h = startStep(model, targets, elapsed_s, body);
  solve(model, targets, surroundings, body);
  // A long gap is simulated as a shorter step, but the body moved during the whole gap.
  if (elapsed_s > 0.0) {
    const double passed_s = elapsed_s > config_.max_time_step_s ? elapsed_s : h;
    // Where targets hold the body, they say how it turns.
    if (targets.empty())
      model->free_motion.setVelocity(body->mesh.vertices, solution_, passed_s, &body->velocity);
    else
      body->velocity = (solution_ - body->mesh.vertices) / passed_s;
  }
  body->mesh.vertices.swap(solution_);
}

/// Sets the potential without constraints and the start of the minimisation. @return the time step [s].
double ImplicitEuler::startStep(BodyModel* model, const std::vector<Target>& targets, double elapsed_s,
                                BodyState* body) {
  const bool moves = elapsed_s > 0.0;
  const double h = moves ? timeStep(std::min(elapsed_s, config_.max_time_step_s)) : kNominalTimeStep;
  free_.inertia = model->masses / (h * h);
  free_.prediction = body->mesh.vertices;
  free_.loads.setZero(model->masses.size(), 3);
  if (moves) {
    body->velocity *= std::pow(1.0 - damping_, h / kNominalTimeStep);
    model->occluded_piece_damping.apply(targets, elapsed_s, &body->velocity);
    if (targets.empty())
      model->free_motion.advance(body->velocity, h, &free_.prediction);
    else
      free_.prediction += h * body->velocity;
    free_.loads.noalias() = model->masses * config_.gravity.transpose();
  }
  // The start includes gravity but not the estimated loads: the body's stiffness balances those.
  solution_ = free_.prediction + free_.inertia.cwiseInverse().asDiagonal() * free_.loads;
  if (moves) free_.loads += model->masses.asDiagonal() * body->loads.per_mass;
  return h;
}

void ImplicitEuler::settle(BodyModel* model, const std::vector<Target>& targets,
                           const Surroundings& surroundings, BodyState* body) {
  free_.inertia.setZero(model->masses.size());
  free_.prediction = solution_ = body->mesh.vertices;
  free_.loads.noalias() = model->masses * config_.gravity.transpose();
  Points loads = free_.loads;
  if (surroundings.loads.size() > 0) loads += surroundings.loads;
  requireHeld(model->topology, targets, surroundings, loads);
  solve(model, targets, surroundings, body);
  body->mesh.vertices.swap(solution_);
  body->velocity.setZero();
}

void ImplicitEuler::solve(BodyModel* model, const std::vector<Target>& targets,
                          const Surroundings& surroundings, BodyState* body) {
  contact_.obstacle_poses.clear();
  for (const Obstacle& obstacle : surroundings.obstacles) contact_.obstacle_poses.push_back(obstacle.pose);
  if (surroundings.obstacles_changed ||
      body->contact.obstacle_poses.size() != contact_.obstacle_poses.size()) {
    body->contact.obstacle_poses = contact_.obstacle_poses;
    body->contact.contacts.clear();
  }
  const ConstrainedStep::Result& result = model->constrained_step.solve(
      free_, targets, surroundings, body->mesh.vertices, body->contact, &solution_);
  if (!solution_.allFinite() || !std::isfinite(result.report.residual_n))
    throw std::runtime_error("loads or targets leave a step without a finite result");
  body->report = result.report;
  body->reactions = result.reactions;
  contact_.contacts.reserve(result.contacts.capacity());
  contact_.contacts = result.contacts;
  std::swap(body->contact, contact_);
}

}  // namespace softbody
