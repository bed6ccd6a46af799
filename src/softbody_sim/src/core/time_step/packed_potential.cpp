#include "time_step/packed_potential.h"

namespace softbody {
namespace {

template <typename T>
TargetRow<T> toRow(const TargetEnergy::Spring& spring, const Eigen::RowVector3d& origin) {
  TargetRow<T> row{};
  for (int k = 0; k < 4; ++k) {
    row.corners[k] = 4 * spring.vertices[k];
    row.barycentric[k] = static_cast<T>(spring.barycentric[k]);
    row.other_corners[k] = 4 * spring.other_vertices[k];
    row.other_barycentric[k] = static_cast<T>(spring.other_barycentric[k]);
  }
  row.is_coupled = spring.isCoupled();
  // The coordinates sum to 1 only within rounding: subtract the origin times their sum.
  const double sum = spring.barycentric.sum() - spring.other_barycentric.sum();
  const Eigen::Vector3d position = spring.position - sum * origin.transpose();
  for (int k = 0; k < 3; ++k) {
    row.position[k] = static_cast<T>(position[k]);
    row.normal[k] = static_cast<T>(spring.normal[k]);
  }
  row.stiffness = static_cast<T>(spring.stiffness);
  row.has_normal = !spring.normal.isZero(0.0);
  row.one_sided = spring.one_sided;
  row.slide = static_cast<T>(spring.slide_m);
  row.is_friction = spring.isFriction();
  return row;
}

}  // namespace

template <typename T>
PackedPotential<T>::PackedPotential(Eigen::Index vertex_count, Simd simd)
    : inertia_(Rows<T>::Zero(paddedRows(vertex_count), 4)),
      prediction_(inertia_),
      loads_(inertia_),
      kernel_(potentialKernel<T>(simd)) {}

template <typename T>
void PackedPotential<T>::set(const IncrementalPotential& potential, const Eigen::RowVector3d& origin) {
  origin_ = origin;
  for (Eigen::Index v = 0; v < potential.inertia.size(); ++v) {
    inertia_.row(v).setConstant(static_cast<T>(potential.inertia[v]));
  }
  toRows(potential.prediction, &prediction_);
  loads_.topLeftCorner(potential.loads.rows(), 3) = potential.loads.cast<T>();
  targets_.clear();
  for (const TargetEnergy::Spring& spring : potential.targets.springs()) {
    targets_.push_back(toRow<T>(spring, origin_));
  }
}

template <typename T>
double PackedPotential<T>::evaluate(const Rows<T>& x, Rows<T>* gradient) const {
  const PotentialView<T> view{static_cast<std::size_t>(inertia_.size()),
                              inertia_.data(),
                              prediction_.data(),
                              loads_.data(),
                              targets_.data(),
                              targets_.size()};
  return kernel_(view, x.data(), gradient->data());
}

template <typename T>
void PackedPotential<T>::toRows(const Points& points, Rows<T>* rows) const {
  rows->col(3).setZero();
  rows->topLeftCorner(points.rows(), 3) = (points.rowwise() - origin_).template cast<T>();
}

template <typename T>
void PackedPotential<T>::fromRows(const Rows<T>& rows, Points* points) const {
  *points = rows.topLeftCorner(points->rows(), 3).template cast<double>().rowwise() + origin_;
}

template class PackedPotential<float>;
template class PackedPotential<double>;

}  // namespace softbody
