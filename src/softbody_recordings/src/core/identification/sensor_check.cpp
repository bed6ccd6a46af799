#include "identification/sensor_check.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>

#include "softbody_common/time/time.h"

namespace softbody {
namespace {

constexpr double kClear = 4.0;  // standard errors

/// Measured minus simulated force of a sensor over time.
struct Misread {
  std::vector<double> times_s;
  std::vector<Eigen::Vector3d> forces;  ///< [N]
  double std_n = 0.0;
};

Misread misreadOf(std::size_t sensor, const MaterialProblem& problem, const MaterialEstimate& estimate) {
  Misread misread;
  for (std::size_t k = 0; k < problem.observations.size(); ++k)
    for (std::size_t w = 0; w < problem.observations[k].wrenches.size(); ++w) {
      const MeasuredWrench& measured = problem.observations[k].wrenches[w];
      if (measured.sensor != static_cast<int>(sensor)) continue;
      misread.times_s.push_back(seconds(problem.observations[k].stamp - problem.observations.front().stamp));
      misread.forces.push_back(measured.value.force - estimate.observations[k].wrenches[w].force);
      misread.std_n = std::max(misread.std_n, measured.force_std_n);
    }
  return misread;
}

}  // namespace

/// A straight line through the misread force of each axis.
std::string sensorSentences(const MaterialProblem& problem, const MaterialEstimate& estimate,
                            const std::vector<WrenchRecord>& records) {
  std::string text;
  for (std::size_t sensor = 0; sensor < records.size(); ++sensor) {
    const Misread misread = misreadOf(sensor, problem, estimate);
    const auto count = static_cast<Eigen::Index>(misread.forces.size());
    if (records[sensor].always || count < 5) continue;
    Eigen::MatrixXd basis(count, 2), forces(count, 3);
    for (Eigen::Index k = 0; k < count; ++k) {
      basis.row(k) << 1.0, misread.times_s[static_cast<std::size_t>(k)];
      forces.row(k) = misread.forces[static_cast<std::size_t>(k)].transpose();
    }
    const Eigen::Matrix2d covariance =
        (basis.transpose() * basis + 1e-12 * Eigen::Matrix2d::Identity()).inverse();
    const Eigen::Matrix<double, 2, 3> line = covariance * (basis.transpose() * forces);
    const Eigen::MatrixXd rest = forces - basis * line;
    const double noise =
        std::max(misread.std_n, std::sqrt(rest.squaredNorm() / (3.0 * static_cast<double>(count - 2))));
    const double duration = misread.times_s.back(), drift = line.row(1).norm(),
                 mean = forces.colwise().mean().norm();
    if (drift > kClear * noise * std::sqrt(covariance(1, 1)))
      text += fmt::format(
          "the sensor of {} drifts: it reads {:.2g} N more after {:.1f} s than the body explains; let it "
          "warm up, "
          "and set its zero before the recording\n",
          records[sensor].source, drift * duration, duration);
    else if (mean > kClear * noise / std::sqrt(static_cast<double>(count)))
      text += fmt::format(
          "the sensor of {} reads {:.2g} N that the body does not explain; set its zero while nothing "
          "touches it\n",
          records[sensor].source, mean);
  }
  return text;
}

}  // namespace softbody
