#include "softbody_sim/surroundings/pinned_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace softbody {
namespace {

/// Those of before that still exist, and those that lie in the box now. Ascending.
std::vector<int> stillHeld(const std::vector<int>& before, const std::vector<int>& inside,
                           Eigen::Index count) {
  std::vector<int> held;
  std::set_union(before.begin(), std::lower_bound(before.begin(), before.end(), static_cast<int>(count)),
                 inside.begin(), inside.end(), std::back_inserter(held));
  return held;
}

}  // namespace

PinnedVertices::PinnedVertices(PinRegion region, const BodySurface& surface, const Points& rest_vertices)
    : region_(std::move(region)) {
  if (region_.in_frame) return;
  vertices_ =
      surface.verticesAtRest(fmt::format("the box of pin '{}'", region_.name), region_.box(), rest_vertices);
}

void PinnedVertices::hold(const BodySurface& surface, const Eigen::Isometry3d& frame_pose,
                          const Points& vertices) {
  if (region_.in_frame) vertices_ = surface.verticesToHold(region_.box(), frame_pose.inverse(), vertices);
  positions_.emplace(static_cast<Eigen::Index>(vertices_.size()), 3);
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    positions_->row(static_cast<Eigen::Index>(k)) =
        frame_pose.inverse() * Eigen::Vector3d(vertices.row(vertices_[k]));
  }
}

void PinnedVertices::updateVertices(const BodySurface& surface, const Points& rest_vertices,
                                    const Points& vertices) {
  const std::vector<int> before = vertices_;
  if (region_.in_frame) {
    std::vector<int> inside;  // nothing of a body that is not placed
    if (vertices.rows() > 0) inside = surface.verticesToHold(region_.box(), frame_pose_.inverse(), vertices);
    vertices_ = stillHeld(before, inside, rest_vertices.rows());
  } else {
    vertices_ = surface.verticesToHold(region_.box(), Eigen::Isometry3d::Identity(), rest_vertices);
  }
  if (vertices.rows() == 0) positions_.reset();
  if (!positions_) return;
  Points positions(static_cast<Eigen::Index>(vertices_.size()), 3);
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    const auto known = std::lower_bound(before.begin(), before.end(), vertices_[k]);
    const auto row = static_cast<Eigen::Index>(k);
    if (known != before.end() && *known == vertices_[k])
      positions.row(row) = positions_->row(known - before.begin());
    else
      positions.row(row) = frame_pose_.inverse() * Eigen::Vector3d(vertices.row(vertices_[k]));
  }
  positions_ = std::move(positions);
}

void PinnedVertices::setFramePose(const std::optional<Eigen::Isometry3d>& pose) {
  acts_ = positions_ && (pose || acts_);
  if (acts_ && pose) frame_pose_ = *pose;
}

void PinnedVertices::appendPins(double accuracy_m, std::vector<Pin>* pins) const {
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    const Eigen::Vector3d position = positions_->row(static_cast<Eigen::Index>(k));
    pins->push_back({vertices_[k], frame_pose_ * position, accuracy_m});
  }
}

}  // namespace softbody
