#include "constraints/target_energy.h"

#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

using Spring = TargetEnergy::Spring;
using SpringIterator = std::vector<Spring>::const_iterator;

bool samePlace(const Spring& a, const Spring& b) {
  return a.tet == b.tet && a.barycentric == b.barycentric && a.other_tet == b.other_tet &&
         a.other_barycentric == b.other_barycentric;
}

/// Of a coupled spring: (a - b)^2 <= 2 a^2 + 2 b^2.
double metricStiffness(const Spring& spring) { return (spring.isCoupled() ? 2.0 : 1.0) * spring.stiffness; }

void addMetricVectors(const Spring& spring, double stiffness, std::vector<TetVector>* vectors) {
  vectors->push_back({spring.vertices, std::sqrt(stiffness) * spring.barycentric});
  if (spring.isCoupled())
    vectors->push_back({spring.other_vertices, std::sqrt(stiffness) * spring.other_barycentric});
}

/// Force relative to that of a spring that never slides. @param offset as it costs energy [m].
double holdOf(const Spring& spring, const Eigen::Vector3d& offset) {
  const double length = offset.norm();
  return spring.isFriction() && length > spring.slide_m ? spring.slide_m / length : 1.0;
}

/// Whether one of the next `max_count` springs has the same place.
bool soonFollows(SpringIterator first, SpringIterator end, const Spring& spring, std::size_t max_count) {
  const auto last = first + std::min<std::ptrdiff_t>(end - first, static_cast<std::ptrdiff_t>(max_count) + 1);
  return std::any_of(first, last, [&](const Spring& other) { return samePlace(other, spring); });
}

}  // namespace

void TargetEnergy::set(const std::vector<Target>& targets, const Tets& tets, double unit_stiffness) {
  springs_.clear();
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

void TargetEnergy::addFriction(const MaterialPoint& place, const Tets& tets, const Eigen::Vector3d& anchor,
                               const Eigen::Vector3d& normal, double stiffness, double largest_force) {
  addOneSided(place, tets, anchor, normal, stiffness);
  springs_.back().one_sided = false;
  springs_.back().slide_m = largest_force / stiffness;
}

void TargetEnergy::coupleLast(const MaterialPoint& other, const Tets& tets) {
  Spring& spring = springs_.back();
  spring.other_tet = other.tet;
  spring.other_vertices = tets.row(other.tet);
  spring.other_barycentric = other.barycentric;
}

/// Offset of the point from the spring's position, as far as it costs energy [m].
Eigen::Vector3d TargetEnergy::offsetOf(const Spring& spring, const Points& x) {
  Eigen::Vector3d offset = -spring.position;
  for (int k = 0; k < 4; ++k) offset += spring.barycentric[k] * x.row(spring.vertices[k]).transpose();
  for (int k = 0; k < 4 && spring.isCoupled(); ++k)
    offset -= spring.other_barycentric[k] * x.row(spring.other_vertices[k]).transpose();
  if (spring.normal.isZero(0.0)) return offset;
  const double distance = spring.normal.dot(offset);
  if (spring.isFriction()) return offset - distance * spring.normal;
  return (spring.one_sided ? std::min(distance, 0.0) : distance) * spring.normal;
}

double TargetEnergy::addTo(const Points& x, Points* gradient) const {
  double energy = 0.0;
  for (const Spring& spring : springs_) {
    const Eigen::Vector3d offset = offsetOf(spring, x);
    const double hold = holdOf(spring, offset);
    energy += 0.5 * spring.stiffness * hold * (2.0 - hold) * offset.squaredNorm();
    const double scale = spring.stiffness * hold;
    for (int k = 0; k < 4; ++k)
      gradient->row(spring.vertices[k]) += scale * spring.barycentric[k] * offset.transpose();
    for (int k = 0; k < 4 && spring.isCoupled(); ++k)
      gradient->row(spring.other_vertices[k]) -= scale * spring.other_barycentric[k] * offset.transpose();
  }
  return energy;
}

void TargetEnergy::addMetric(TetMatrix* matrix) const {
  for (const Spring& spring : springs_) {
    const double stiffness = metricStiffness(spring);
    matrix->addToTet(spring.tet, stiffness * spring.barycentric * spring.barycentric.transpose());
    if (spring.isCoupled())
      matrix->addToTet(spring.other_tet,
                       stiffness * spring.other_barycentric * spring.other_barycentric.transpose());
  }
}

/// (s . x)^2 <= sum |s_i| sum |s_i| x_i^2.
void TargetEnergy::addMetricBound(Eigen::VectorXd* diagonal) const {
  const auto add = [&](const Eigen::Vector4i& vertices, const Eigen::Vector4d& barycentric,
                       double stiffness) {
    const Eigen::Vector4d weights = barycentric.cwiseAbs();
    for (int k = 0; k < 4; ++k) (*diagonal)[vertices[k]] += stiffness * weights.sum() * weights[k];
  };
  for (const Spring& spring : springs_) {
    add(spring.vertices, spring.barycentric, metricStiffness(spring));
    if (spring.isCoupled()) add(spring.other_vertices, spring.other_barycentric, metricStiffness(spring));
  }
}

bool TargetEnergy::hasContact() const {
  return std::any_of(springs_.begin(), springs_.end(), [](const Spring& spring) { return spring.one_sided; });
}

bool TargetEnergy::hasCoupled() const {
  return std::any_of(springs_.begin(), springs_.end(),
                     [](const Spring& spring) { return spring.isCoupled(); });
}

Eigen::Matrix3d TargetEnergy::curvatureAt(const Spring& spring, const Points& x) {
  const Eigen::Matrix3d all = spring.stiffness * Eigen::Matrix3d::Identity();
  if (spring.normal.isZero(0.0)) return all;
  const Eigen::Vector3d offset = offsetOf(spring, x);
  const Eigen::Matrix3d along = spring.stiffness * spring.normal * spring.normal.transpose();
  if (!spring.isFriction()) return spring.one_sided && offset.isZero(0.0) ? Eigen::Matrix3d::Zero() : along;
  const double hold = holdOf(spring, offset);
  if (hold == 1.0) return all - along;
  const Eigen::Vector3d direction = offset.normalized();
  return hold * (all - along - spring.stiffness * direction * direction.transpose());
}

void TargetEnergy::addHessian(const Points& x, BlockTetMatrix* matrix) const {
  for (const Spring& spring : springs_) {
    const Eigen::Matrix3d curvature = curvatureAt(spring, x);
    if (curvature.isZero(0.0)) continue;
    const auto add = [&](int tet, const Eigen::Vector4d& barycentric) {
      Eigen::Matrix<double, 12, 12> block;
      for (Eigen::Index a = 0; a < 4; ++a) {
        for (Eigen::Index b = 0; b < 4; ++b)
          block.block<3, 3>(3 * a, 3 * b) = barycentric[a] * barycentric[b] * curvature;
      }
      matrix->addToGroup(static_cast<std::size_t>(tet), block);
    };
    add(spring.tet, spring.barycentric);
    if (spring.isCoupled()) add(spring.other_tet, spring.other_barycentric);
  }
}

void TargetEnergy::addCouplings(const Points& x, std::vector<Eigen::Triplet<double>>* entries) const {
  for (const Spring& spring : springs_) {
    if (!spring.isCoupled()) continue;
    const Eigen::Matrix3d curvature = curvatureAt(spring, x);
    const auto add = [&](int row, int column, double value) {
      if (row >= column) entries->emplace_back(row, column, value);
    };
    for (int k = 0; k < 16; ++k) {
      const int a = 3 * spring.vertices[k / 4], b = 3 * spring.other_vertices[k % 4];
      const double weight = -spring.barycentric[k / 4] * spring.other_barycentric[k % 4];
      for (int c = 0; c < 9 && weight != 0.0; ++c) {
        const double value = weight * curvature(c / 3, c % 3);
        add(a + c / 3, b + c % 3, value);
        add(b + c % 3, a + c / 3, value);
      }
    }
  }
}

bool TargetEnergy::metricChanges(const TargetEnergy& earlier, std::size_t max_count,
                                 std::vector<TetVector>* added, std::vector<TetVector>* removed) const {
  added->clear();
  removed->clear();
  const auto count = [&] { return added->size() + removed->size(); };
  auto before = earlier.springs_.begin(), now = springs_.begin();
  const auto before_end = earlier.springs_.end(), now_end = springs_.end();
  while ((before != before_end || now != now_end) && count() <= max_count) {
    if (before != before_end && now != now_end && samePlace(*before, *now)) {
      const double change = metricStiffness(*now) - metricStiffness(*before);
      if (change != 0.0) addMetricVectors(*now, std::abs(change), change > 0.0 ? added : removed);
      ++before;
      ++now;
    } else if (now != now_end &&
               (before == before_end || !soonFollows(before, before_end, *now, max_count))) {
      addMetricVectors(*now, metricStiffness(*now), added);
      ++now;
    } else {
      addMetricVectors(*before, metricStiffness(*before), removed);
      ++before;
    }
  }
  return count() <= max_count;
}

}  // namespace softbody
