#include "tools/simulation_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

std::string numbers(const Eigen::Vector3d& v) {
  return fmt::format(",{:.6g},{:.6g},{:.6g}", v.x(), v.y(), v.z());
}

/// How deep the deepest vertex is in an obstacle [m].
double depth(const Points& x, const std::vector<Obstacle>& obstacles) {
  double deepest = 0.0;
  for (const Obstacle& obstacle : obstacles) {
    const Eigen::Isometry3d into = obstacle.pose.inverse();
    for (Eigen::Index v = 0; v < x.rows(); ++v)
      deepest = std::max(deepest, -distanceTo(obstacle, into * Eigen::Vector3d(x.row(v))).distance);
  }
  return deepest;
}

std::string sumOfPins(const Simulator& simulator) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Wrench& pin : simulator.reactions().pins) sum += pin.force;
  return numbers(sum);
}

}  // namespace

std::string SimulationTable::header() const {
  std::string line =
      "step,time_s,probe_x_m,probe_y_m,probe_z_m,elastic_energy_j,residual_n,volume_m3,"
      "pins_x_n,pins_y_n,pins_z_n,iterations,converged,speed_m_s,depth_m";
  for (std::size_t k = 1; k <= problem_.held.size(); ++k) {
    for (const char* unit : {"n", "nm"}) {
      for (const char* axis : {"x", "y", "z"}) line += fmt::format(",region_{}_{}_{}", k, axis, unit);
    }
  }
  for (const std::string& name : problem_.obstacle_names) {
    for (const char* axis : {"x", "y", "z"}) line += fmt::format(",{}_{}_n", name, axis);
  }
  return line + '\n';
}

std::string SimulationTable::row(int step, double time_s, double time_step_s, const Points& before,
                                 double share, const StepReport& report, const Simulator& simulator) const {
  const TetTopology& topology = simulator.topology();
  const Points& x = simulator.state().vertices;
  Eigen::RowVector3d tip = Eigen::RowVector3d::Zero();
  for (int v : probe_) tip += (x.row(v) - topology.rest_vertices.row(v)) / static_cast<double>(probe_.size());
  const double speed = time_step_s > 0.0 ? (x - before).rowwise().norm().maxCoeff() / time_step_s : 0.0;
  return fmt::format("{},{:.6g},{:.9g},{:.9g},{:.9g},{:.9g},{:.3g},{:.9g}", step, time_s, tip.x(), tip.y(),
                     tip.z(), simulator.elasticEnergy(), report.residual_n,
                     tetVolumes(x, topology.tets).sum()) +
         sumOfPins(simulator) +
         fmt::format(",{},{},{:.6g},{:.6g}", report.iterations, report.converged ? 1 : 0, speed,
                     depth(x, problem_.at(share).obstacles)) +
         reactions(share, simulator) + '\n';
}

std::string SimulationTable::reactions(double share, const Simulator& simulator) const {
  std::string text;
  for (const Wrench& held : problem_.held.wrenches(simulator.reactions().pins, share))
    text += numbers(held.force) + numbers(held.torque);
  for (const Wrench& obstacle : simulator.reactions().obstacles) text += numbers(obstacle.force);
  return text;
}

std::string describeHeld(const HeldRegions& held, double share, const Simulator& simulator) {
  std::string text;
  const std::vector<Wrench> wrenches = held.wrenches(simulator.reactions().pins, share);
  for (std::size_t k = 0; k < wrenches.size(); ++k) {
    const Eigen::Vector3d &f = wrenches[k].force, &t = wrenches[k].torque;
    text += fmt::format(
        "simulate: the body acts on region {} ('{}') with the force ({:.4g}, {:.4g}, {:.4g}) N and, about "
        "its "
        "centre, the torque ({:.4g}, {:.4g}, {:.4g}) N m\n",
        k + 1, held.name(k), f.x(), f.y(), f.z(), t.x(), t.y(), t.z());
  }
  return text;
}

}  // namespace softbody
