#include "identification/residuals.h"

#include <cmath>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/protocol/target_limits.h"

namespace softbody {

Residuals::Residuals(const MaterialProblem& problem) {
  std::vector<ResidualPlace> of_wrenches;
  int image = 0;
  for (const ShapeObservation& observation : problem.observations) {
    for (std::size_t k = 0; k < observation.targets.size(); ++k) {
      const Target& target = observation.targets[k];
      if (!observation.images.empty()) image = observation.images[k];
      targets_.push_back(&target);
      const ResidualPlace place{
          positionOf(target.place, problem.topology.rest_vertices, problem.topology.tets), -1, image,
          static_cast<int>(target.kind)};
      places_.insert(places_.end(), target.normal.isZero(0.0) ? 3 : 1, place);
    }
    if (observation.images.empty()) ++image;
    for (const MeasuredWrench& wrench : observation.wrenches) {
      wrenches_.push_back(&wrench);
      of_wrenches.insert(of_wrenches.end(), wrench.torque_std_nm > 0.0 ? 6 : 3,
                         {Eigen::Vector3d::Zero(), wrench.sensor, image, kGroups - 1});
    }
  }
  places_.insert(places_.end(), of_wrenches.begin(), of_wrenches.end());
}

/// Differences of places, #targets by 3, and of wrenches, over their standard deviations.
Eigen::VectorXd Residuals::whitened(const Points& places, const Eigen::VectorXd& wrenches) const {
  Eigen::VectorXd rows(size());
  Eigen::Index row = 0;
  for (std::size_t k = 0; k < targets_.size(); ++k) {
    const Target& target = *targets_[k];
    const Eigen::Vector3d difference =
        places.row(static_cast<Eigen::Index>(k)) * std::sqrt(target.weight) / kTargetAccuracy_m;
    if (target.normal.isZero(0.0)) {
      rows.segment<3>(row) = difference;
      row += 3;
    } else {
      rows[row++] = target.normal.dot(difference);
    }
  }
  for (std::size_t k = 0; k < wrenches_.size(); ++k) {
    const MeasuredWrench& wrench = *wrenches_[k];
    const auto difference = wrenches.segment<6>(6 * static_cast<Eigen::Index>(k));
    rows.segment<3>(row) = difference.head<3>() / wrench.force_std_n;
    row += 3;
    if (!(wrench.torque_std_nm > 0.0)) continue;
    rows.segment<3>(row) = difference.tail<3>() / wrench.torque_std_nm;
    row += 3;
  }
  return rows;
}

Eigen::VectorXd Residuals::at(const Prediction& prediction, const Eigen::Isometry3d& alignment) const {
  Points places = transformed(prediction.places, alignment);
  for (std::size_t k = 0; k < targets_.size(); ++k)
    places.row(static_cast<Eigen::Index>(k)) -= targets_[k]->position.transpose();
  Eigen::VectorXd wrenches = prediction.wrenches;
  for (std::size_t k = 0; k < wrenches_.size(); ++k) {
    auto row = wrenches.segment<6>(6 * static_cast<Eigen::Index>(k));
    row.head<3>() -= wrenches_[k]->value.force;
    row.tail<3>() -= wrenches_[k]->value.torque;
  }
  return whitened(places, wrenches);
}

Eigen::VectorXd Residuals::change(const Prediction& from, const Prediction& to,
                                  const Eigen::Isometry3d& alignment) const {
  const Points places = (to.places - from.places) * alignment.linear().transpose();
  return whitened(places, to.wrenches - from.wrenches);
}

Eigen::MatrixXd Residuals::byAlignment(const Prediction& prediction, const Eigen::Isometry3d& alignment,
                                       const Eigen::Vector3d& center) const {
  const Points places = transformed(prediction.places, alignment).rowwise() - center.transpose();
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(prediction.wrenches.size());
  Eigen::MatrixXd rows(size(), 6);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::RowVector3d unit = Eigen::RowVector3d::Unit(axis);
    rows.col(axis) = whitened(Points::Ones(places.rows(), 3) * unit.asDiagonal(), none);
    Points turned(places.rows(), 3);
    for (Eigen::Index k = 0; k < places.rows(); ++k) turned.row(k) = unit.cross(places.row(k));
    rows.col(3 + axis) = whitened(turned, none);
  }
  return rows;
}

}  // namespace softbody
