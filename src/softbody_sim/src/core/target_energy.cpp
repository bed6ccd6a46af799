#include "core/target_energy.h"

#include <algorithm>

namespace softbody {

void TargetEnergy::set(const std::vector<Target>& targets, const Tets& tets, double unit_stiffness) {
  springs_.clear();
  springs_.reserve(targets.size());
  for (const Target& target : targets) {
    springs_.push_back({target.place.tet, tets.row(target.place.tet), target.place.barycentric,
                        target.position, target.normal.normalized(), target.weight * unit_stiffness});
  }
}

void TargetEnergy::addOneSided(const MaterialPoint& place, const Tets& tets, const Eigen::Vector3d& position,
                               const Eigen::Vector3d& normal, double stiffness) {
  springs_.push_back(
      {place.tet, tets.row(place.tet), place.barycentric, position, normal.normalized(), stiffness, true});
}

/// The way from the spring's position to its point that costs energy.
Eigen::Vector3d TargetEnergy::offsetOf(const Spring& spring, const Points& x) {
  Eigen::Vector3d offset = -spring.position;
  for (int k = 0; k < 4; ++k) offset += spring.barycentric[k] * x.row(spring.vertices[k]).transpose();
  if (spring.normal.isZero(0.0)) return offset;
  const double distance = spring.normal.dot(offset);
  return (spring.one_sided ? std::min(distance, 0.0) : distance) * spring.normal;
}

double TargetEnergy::addTo(const Points& x, Points* gradient) const {
  double energy = 0.0;
  for (const Spring& spring : springs_) {
    const Eigen::Vector3d offset = offsetOf(spring, x);
    energy += 0.5 * spring.stiffness * offset.squaredNorm();
    for (int k = 0; k < 4; ++k) {
      gradient->row(spring.vertices[k]) += spring.stiffness * spring.barycentric[k] * offset.transpose();
    }
  }
  return energy;
}

void TargetEnergy::addMetric(TetMatrix* matrix) const {
  for (const Spring& spring : springs_) {
    matrix->addToTet(spring.tet, spring.stiffness * spring.barycentric * spring.barycentric.transpose());
  }
}

void TargetEnergy::addHessian(const Points& x, BlockTetMatrix* matrix) const {
  for (const Spring& spring : springs_) {
    if (spring.one_sided && offsetOf(spring, x).isZero(0.0)) continue;
    const Eigen::Matrix3d curvature = spring.normal.isZero(0.0)
                                          ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
                                          : Eigen::Matrix3d(spring.normal * spring.normal.transpose());
    BlockTetMatrix::TetBlock block;
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        block.block<3, 3>(3 * a, 3 * b) =
            spring.stiffness * spring.barycentric[a] * spring.barycentric[b] * curvature;
      }
    }
    matrix->addToTet(spring.tet, block);
  }
}

bool TargetEnergy::sameMetric(const TargetEnergy& other) const {
  const auto same = [](const Spring& a, const Spring& b) {
    return a.tet == b.tet && a.stiffness == b.stiffness && a.barycentric == b.barycentric;
  };
  return std::equal(springs_.begin(), springs_.end(), other.springs_.begin(), other.springs_.end(), same);
}

}  // namespace softbody
