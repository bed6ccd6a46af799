#include "solid/free_motion.h"

#include <cmath>

#include "solid/held_solid.h"

namespace softbody::virtual_camera {
namespace {

/// One over the mass of each unknown; 0 for the held ones.
Eigen::VectorXd inverseMasses(const HexSolid& solid, const FreeMotion& motion) {
  const Eigen::VectorXd volumes = solid.nodalVolumes();
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(solid.unknowns());
  for (Eigen::Index i = 0; i < volumes.size(); ++i) {
    if (!motion.held[static_cast<std::size_t>(i)])
      inverse.segment<3>(3 * i).setConstant(1.0 / (motion.density * volumes[i]));
  }
  return inverse;
}

/// The largest angular frequency of small motions around the rest shape [rad/s], by power iteration.
double largestFrequency(const HexSolid& solid, const Eigen::VectorXd& inverse_masses) {
  constexpr int kIterations = 60;
  Triplets triplets;
  solid.addStiffness(solid.rest(), false, &triplets);
  Eigen::SparseMatrix<double> stiffness(solid.unknowns(), solid.unknowns());
  stiffness.setFromTriplets(triplets.begin(), triplets.end());
  Eigen::VectorXd mode(solid.unknowns());
  for (Eigen::Index i = 0; i < mode.size(); ++i) mode[i] = std::sin(12.9898 * static_cast<double>(i + 1));
  double squared = 0.0;
  for (int count = 0; count < kIterations; ++count) {
    const Eigen::VectorXd forces = stiffness.selfadjointView<Eigen::Lower>() * mode.normalized();
    mode = inverse_masses.cwiseProduct(forces);
    squared = mode.norm();
  }
  return std::sqrt(squared);
}

}  // namespace

std::vector<Eigen::VectorXd> moveFreely(const HexSolid& solid, const FreeMotion& motion, double interval_s,
                                        int intervals) {
  const Eigen::VectorXd inverse_masses = inverseMasses(solid, motion);
  constexpr double kStep = 1.4;  // over the largest frequency; 2 would be just stable
  const double largest_step = kStep / largestFrequency(solid, inverse_masses);
  const int steps = static_cast<int>(std::ceil(interval_s / largest_step));
  const double step = interval_s / steps, kept = std::exp(-0.5 * step * motion.damping_1_s);
  const auto acceleration = [&](const Eigen::VectorXd& nodes) -> Eigen::VectorXd {
    return inverse_masses.cwiseProduct(motion.loads - holdingForces(solid, nodes));
  };
  std::vector<Eigen::VectorXd> states = {motion.start};
  Eigen::VectorXd nodes = motion.start, velocity = Eigen::VectorXd::Zero(nodes.size());
  Eigen::VectorXd accelerated = acceleration(nodes);
  for (int interval = 0; interval < intervals; ++interval) {
    for (int count = 0; count < steps; ++count) {
      velocity = kept * velocity + 0.5 * step * accelerated;
      nodes += step * velocity;
      accelerated = acceleration(nodes);
      velocity = kept * (velocity + 0.5 * step * accelerated);
    }
    states.push_back(nodes);
  }
  return states;
}

}  // namespace softbody::virtual_camera
