#include "core/step_rows.h"

#include <algorithm>

namespace softbody {
namespace {

template <typename T>
TargetRow<T> toRow(const TargetEnergy::Spring& spring, const Eigen::RowVector3d& origin) {
  TargetRow<T> row{};
  for (int k = 0; k < 4; ++k) {
    row.vertices[k] = spring.vertices[k];
    row.barycentric[k] = static_cast<T>(spring.barycentric[k]);
  }
  // Barycentric coordinates that do not quite sum to 1 move the origin, too.
  const Eigen::Vector3d position = spring.position - spring.barycentric.sum() * origin.transpose();
  for (int k = 0; k < 3; ++k) {
    row.position[k] = static_cast<T>(position[k]);
    row.normal[k] = static_cast<T>(spring.normal[k]);
  }
  row.stiffness = static_cast<T>(spring.stiffness);
  row.has_normal = !spring.normal.isZero(0.0);
  row.one_sided = spring.one_sided;
  return row;
}

}  // namespace

template <typename T>
StepRows<T>::StepRows(Eigen::Index vertex_count, Simd simd)
    : inertia_(vertex_count),
      prediction_(Rows<T>::Zero(paddedRows(vertex_count), 4)),
      loads_(prediction_),
      add_targets_(targetKernel<T>(simd)) {}

template <typename T>
void StepRows<T>::set(const StepPotential& potential, const Eigen::RowVector3d& origin) {
  origin_ = origin;
  inertia_ = potential.inertia.array().template cast<T>();
  toRows(potential.prediction, &prediction_);
  loads_.topLeftCorner(potential.loads.rows(), 3) = potential.loads.cast<T>();
  targets_.clear();
  for (const TargetEnergy::Spring& spring : potential.targets.springs()) {
    targets_.push_back(toRow<T>(spring, origin_));
  }
}

template <typename T>
double StepRows<T>::evaluate(const Rows<T>& x, Rows<T>* gradient) const {
  using Row = Eigen::Array<T, 1, 4>;
  constexpr Eigen::Index kChunk = 64;  // rows whose energies are summed in the precision T
  double energy = 0.0;
  for (Eigen::Index begin = 0; begin < inertia_.size(); begin += kChunk) {
    Row sum = Row::Zero();
    const Eigen::Index end = std::min(begin + kChunk, inertia_.size());
    for (Eigen::Index v = begin; v < end; ++v) {
      const Row offset = x.row(v).array() - prediction_.row(v).array();
      const Row pull = inertia_[v] * offset, load = loads_.row(v).array();
      sum += (T(0.5) * pull - load) * offset;
      gradient->row(v).array() = pull - load;
    }
    energy += static_cast<double>(sum.sum());
  }
  return energy + add_targets_(targets_.data(), targets_.size(), x.data(), gradient->data());
}

template <typename T>
void StepRows<T>::toRows(const Points& points, Rows<T>* rows) const {
  rows->topLeftCorner(points.rows(), 3) = (points.rowwise() - origin_).template cast<T>();
}

template <typename T>
void StepRows<T>::fromRows(const Rows<T>& rows, Points* points) const {
  *points = rows.topLeftCorner(points->rows(), 3).template cast<double>().rowwise() + origin_;
}

template class StepRows<float>;
template class StepRows<double>;

}  // namespace softbody
