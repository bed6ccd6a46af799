#include "softbody_tracking/known/followed_surface.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/time/time.h"

namespace softbody {
namespace {

// An older state says little about a body that may be moved by hand.
constexpr Nanoseconds kLongestAge = 500'000'000;

double rootMeanSquare(const Points& differences) {
  return std::sqrt(differences.rowwise().squaredNorm().mean());
}

/// Root mean square of a state's own deviations [m]; 0 if it has none.
double ownDeviation(const MeshState& state) {
  if (state.standard_deviation.empty()) return 0.0;
  double squares = 0.0;
  for (const float deviation : state.standard_deviation)
    squares += static_cast<double>(deviation) * deviation;
  return std::sqrt(squares / static_cast<double>(state.standard_deviation.size()));
}

}  // namespace

void FollowedSurface::setTopology(const MeshTopology& topology) {
  if (topology.triangles.rows() == 0) throw std::invalid_argument("it has no triangles");
  if (topology.triangles.minCoeff() < 0 || topology.triangles.maxCoeff() >= topology.rest_vertices.rows())
    throw std::invalid_argument(fmt::format("a triangle names a vertex that is not among its {} vertices",
                                            topology.rest_vertices.rows()));
  topology_ = topology;
}

void FollowedSurface::requireFits(const MeshState& state) const {
  if (topology_ && topology_->revision == state.revision &&
      topology_->rest_vertices.rows() != state.vertices.rows())
    throw std::invalid_argument(fmt::format("{} vertices, but the topology has {}", state.vertices.rows(),
                                            topology_->rest_vertices.rows()));
}

void FollowedSurface::addState(const MeshState& state) {
  requireFits(state);
  if (newest_ && newest_->observed == state.observed) {
    newest_ = state;
    return;
  }
  const bool follows = newest_ && newest_->revision == state.revision &&
                       newest_->vertices.rows() == state.vertices.rows() &&
                       state.observed > newest_->observed;
  error_mps_ = !follows ? 0.0
                        : rootMeanSquare(predicted(state.observed) - state.vertices) /
                              seconds(state.observed - newest_->observed);
  before_ = follows ? newest_ : std::nullopt;
  newest_ = state;
}

/// As far ahead as the last two states are apart, at most twice.
Points FollowedSurface::predicted(Nanoseconds stamp) const {
  if (!before_) return newest_->vertices;
  const double step = seconds(newest_->observed - before_->observed);
  const double ahead = std::min(2.0, seconds(stamp - newest_->observed) / step);
  return newest_->vertices + ahead * (newest_->vertices - before_->vertices);
}

std::optional<KnownSurface> FollowedSurface::at(Nanoseconds stamp,
                                                const Eigen::Isometry3d& T_camera_states) const {
  if (!topology_ || !newest_ || newest_->revision != topology_->revision ||
      newest_->vertices.rows() != topology_->rest_vertices.rows())
    return std::nullopt;
  const Nanoseconds age = std::abs(stamp - newest_->observed);
  if (age > kLongestAge) return std::nullopt;
  KnownSurface known;
  known.name = name_;
  known.surface = {transformed(predicted(stamp), T_camera_states), topology_->triangles};
  known.deviation_m = std::hypot(ownDeviation(*newest_), error_mps_ * seconds(age));
  return known;
}

void FollowedSurface::forgetStates() {
  newest_.reset();
  before_.reset();
  error_mps_ = 0.0;
}

}  // namespace softbody
