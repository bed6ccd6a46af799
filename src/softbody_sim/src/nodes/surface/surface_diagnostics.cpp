#include "nodes/surface/surface_diagnostics.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/ros/time.h"

namespace softbody {

using diagnostic_msgs::DiagnosticStatus;

namespace {

std::string orUnknown(const std::optional<double>& value, double scale) {
  return value ? fmt::format("{:.2f}", scale * *value) : "not known";
}

}  // namespace

SurfaceDiagnostics::SurfaceDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                                       const SurfaceLimits& limits)
    : limits_(limits),
      diagnostics_(node, private_node, "visual mesh", [this](auto& status) { report(&status); }) {}

void SurfaceDiagnostics::onState(const MeshTopology& topology, const MeshState& state,
                                 const ros::Time& stamp) {
  ++states_;
  if (figures_) return;
  Figures figures;
  const double latency = secondsBetween(stamp, ros::Time::now());
  if (latency >= 0.0 && latency < kLongestLatency_s) figures.latency_s = latency;
  figures.volume_drift = enclosedVolume(state.vertices, topology.triangles) /
                             enclosedVolume(topology.rest_vertices, topology.triangles) -
                         1.0;
  const std::vector<float>& deviations = state.standard_deviation;
  if (!deviations.empty()) {
    figures.deviation_m =
        std::accumulate(deviations.begin(), deviations.end(), 0.0) / static_cast<double>(deviations.size());
  }
  figures_ = figures;
}

/// What is wrong, in a sentence; empty: nothing.
std::string SurfaceDiagnostics::warning() const {
  if (refused_ > 0) return fmt::format("{} states of the volume were not used", refused_);
  if (!figures_) return "no state of the volume in the last second: the body is not tracked";
  if (figures_->latency_s && *figures_->latency_s > limits_.latency_s)
    return fmt::format("the mesh is {:.2f} s behind its image; latency_limit_s is {:g}", *figures_->latency_s,
                       limits_.latency_s);
  // Foam can be pressed to less, but not by a hand that leaves most of it in view.
  constexpr double kLargestDrift = 0.3;
  if (!(std::abs(figures_->volume_drift) <= kLargestDrift))
    return fmt::format("the volume differs from that at rest by {:.0f} %; the limit is {:.0f} %",
                       100.0 * figures_->volume_drift, 100.0 * kLargestDrift);
  if (figures_->deviation_m && *figures_->deviation_m > limits_.deviation_m)
    return fmt::format("the mean standard deviation is {:.1f} mm; deviation_limit_m is {:g}",
                       1e3 * *figures_->deviation_m, limits_.deviation_m);
  return "";
}

void SurfaceDiagnostics::report(NodeDiagnostics::Status* status) {
  const ros::WallTime now = ros::WallTime::now();
  const double rate_hz = states_ / std::max(1e-3, (now - reported_).toSec());
  const std::string fault = warning();
  if (fault.empty())
    status->summary(DiagnosticStatus::OK, fmt::format("{:.1f} meshes per second", rate_hz));
  else
    status->summary(DiagnosticStatus::WARN, fault);
  const Figures figures = figures_.value_or(Figures());
  status->add("rate [Hz]", fmt::format("{:.1f}", rate_hz));
  status->add("states refused", refused_);
  status->add("latency [ms]", orUnknown(figures.latency_s, 1e3));
  status->add("volume drift [%]",
              orUnknown(figures_ ? std::optional(figures.volume_drift) : std::nullopt, 100.0));
  status->add("mean standard deviation [mm]", orUnknown(figures.deviation_m, 1e3));
  states_ = refused_ = 0;
  figures_.reset();
  reported_ = now;
}

}  // namespace softbody
