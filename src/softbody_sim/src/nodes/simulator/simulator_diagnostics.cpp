#include "nodes/simulator/simulator_diagnostics.h"

#include <fmt/format.h>

namespace softbody {

using diagnostic_msgs::DiagnosticStatus;

namespace {

std::string joined(const SurroundingsFollower::Faults& faults) {
  std::string text;
  for (const auto& [name, sentence] : faults) text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

}  // namespace

SimulatorDiagnostics::SimulatorDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                           const Simulator* simulator,
                                           const SurroundingsTracker* surroundings)
    : simulator_(simulator),
      surroundings_(surroundings),
      diagnostics_(node, private_node, "simulation", [this](auto& status) { report(&status); }) {}

void SimulatorDiagnostics::countStep() {
  ++steps_;
  if (!simulator_->report().converged) ++steps_not_converged_;
}

void SimulatorDiagnostics::summarize(const SurroundingsFollower::Faults& faults,
                                     NodeDiagnostics::Status* status) const {
  if (refused_ > 0)
    status->summary(DiagnosticStatus::WARN, fmt::format("{} messages with targets were not used", refused_));
  else if (!simulator_->placed())
    status->summary(DiagnosticStatus::WARN, "the body is not placed yet: waiting for targets");
  else if (!faults.empty())
    status->summary(DiagnosticStatus::WARN, joined(faults));
  else if (steps_not_converged_ > 0)
    status->summary(DiagnosticStatus::WARN,
                    fmt::format("{} of {} steps did not converge", steps_not_converged_, steps_));
  else
    status->summary(DiagnosticStatus::OK, fmt::format("all {} steps converged", steps_));
}

void SimulatorDiagnostics::report(NodeDiagnostics::Status* status) {
  const SurroundingsFollower::Faults faults = surroundings_->faults();
  summarize(faults, status);
  const StepReport& last = simulator_->report();
  status->add("steps", steps_);
  status->add("steps not converged", steps_not_converged_);
  status->add("messages refused", refused_);
  status->add("messages dropped to keep up", dropped_);
  status->add("iterations of the last step", last.iterations);
  status->add("last step converged", last.converged);
  status->add("residual of the last step [N]", fmt::format("{:.3g}", last.residual_n));
  status->add("last move [mm]", fmt::format("{:.4f}", 1e3 * last.last_move_m));
  for (const auto& [name, sentence] : faults) status->add(name, sentence);
  steps_ = steps_not_converged_ = refused_ = 0;
}

}  // namespace softbody
