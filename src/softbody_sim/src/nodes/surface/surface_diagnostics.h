#pragma once

#include <ros/ros.h>

#include <optional>
#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_common/ros/node_diagnostics.h"
#include "softbody_sim/ros/surface_options.h"

namespace softbody {

/// Diagnostics of the visual mesh, once a second: rate, latency, volume drift, standard deviation.
class SurfaceDiagnostics {
 public:
  SurfaceDiagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                     const SurfaceLimits& limits);

  void setLimits(const SurfaceLimits& limits) { limits_ = limits; }
  /// A state was published.
  void onState(const MeshTopology& topology, const MeshState& state, const ros::Time& stamp);
  /// A state was not used.
  void countRefused() { ++refused_; }

 private:
  struct Figures {
    std::optional<double> latency_s;  ///< empty: the clock does not run with the stamps
    double volume_drift = 0.0;
    std::optional<double> deviation_m;  ///< empty: not estimated
  };

  std::string warning() const;
  void report(NodeDiagnostics::Status* status);

  SurfaceLimits limits_;
  std::optional<Figures> figures_;  ///< of the first state since the last report
  int states_ = 0, refused_ = 0;    ///< since the last report
  ros::WallTime reported_ = ros::WallTime::now();
  NodeDiagnostics diagnostics_;
};

}  // namespace softbody
