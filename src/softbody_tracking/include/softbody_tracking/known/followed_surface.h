#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "softbody_common/geometry/types.h"
#include "softbody_tracking/known/known_surface.h"

namespace softbody {

/// A surface that another tracker follows. Its states come late. Meanwhile the surface keeps the motion
/// between the last two of them. The error of this motion last time is a part of its deviation.
class FollowedSurface {
 public:
  explicit FollowedSurface(std::string name) : name_(std::move(name)) {}

  const std::string& name() const { return name_; }
  bool hasTopology() const { return topology_.has_value(); }
  /// Whether it has the topology of this revision.
  bool hasTopology(std::uint32_t revision) const { return topology_ && topology_->revision == revision; }
  bool hasState() const { return newest_.has_value(); }

  /// @throw std::invalid_argument if a triangle names a vertex that is not there; the last topology stays.
  void setTopology(const MeshTopology& topology);

  /// @throw std::invalid_argument if the number of a state's vertices is not the topology's.
  void requireFits(const MeshState& state) const;

  /// A state of another revision than the topology's waits for its topology.
  /// @param state `observed` is its stamp. States come in the order of their stamps.
  /// @throw std::invalid_argument as requireFits() does; the last state stays.
  void addState(const MeshState& state);

  /// The surface at a stamp; nothing before the first state and its topology, and if the newest state is more
  /// than 0.5 s old. @param T_camera_states of the states' frame.
  std::optional<KnownSurface> at(Nanoseconds stamp, const Eigen::Isometry3d& T_camera_states) const;

  /// Time has jumped back.
  void forgetStates();

 private:
  Points predicted(Nanoseconds stamp) const;

  std::string name_;
  std::optional<MeshTopology> topology_;
  std::optional<MeshState> newest_, before_;
  double error_mps_ = 0.0;  ///< by which the last prediction was off, over its time [m/s]
};

}  // namespace softbody
