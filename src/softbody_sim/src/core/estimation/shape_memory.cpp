#include "estimation/shape_memory.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "estimation/target_residual.h"

namespace softbody {
namespace {

// A motion goes on for about so long [s]: a swing is slow at its turning points.
constexpr double kMotion_s = 0.1;
// How long the smallest variance holds, in times of the memory: while the body moves all the time, it rises.
constexpr double kHold = 10.0;
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

void forget(Eigen::Index vertices, RememberedShape* memory) {
  memory->frames = Eigen::VectorXd::Zero(vertices);
  memory->noise.setZero(vertices, 2);
  memory->motion.setZero(vertices);
  memory->variance.setConstant(vertices, std::numeric_limits<double>::infinity());
  memory->innovations.setZero(vertices, 3);
  memory->measured.fill(Points::Constant(vertices, 3, kNotMeasured));
}

/// Replaces the rows of values by their sums over the vertices of all tets around each vertex.
template <int Columns>
void sumAround(const Tets& tets, Eigen::Matrix<double, Eigen::Dynamic, Columns, Eigen::RowMajor>* values) {
  const auto of_vertices = *values;
  values->setZero();
  for (const auto& tet : tets.rowwise()) {
    Eigen::Matrix<double, 1, Columns> sum = of_vertices.row(tet[0]);
    for (int k = 1; k < 4; ++k) sum += of_vertices.row(tet[k]);
    for (int k = 0; k < 4; ++k) values->row(tet[k]) += sum;
  }
}

/// Third difference of the places of a vertex over time. It has 1 + 9 + 9 + 1 = 20 times their variance.
Eigen::RowVector3d thirdDifference(Eigen::Index v, const Points& measured,
                                   const std::array<Points, 3>& before) {
  return measured.row(v) - 3.0 * before[0].row(v) + 3.0 * before[1].row(v) - before[2].row(v);
}

/// Sums over the surroundings of a vertex: squares of the innovations of this frame and of the last one,
/// their products, the number of terms; squares of third differences, and their number.
enum Column { kNow, kBefore, kProduct, kCount, kDifference, kDifferenceCount, kColumns };
using Sums = Eigen::Matrix<double, Eigen::Dynamic, kColumns, Eigen::RowMajor>;

Sums sumsOf(const Points& innovations, const Points& measured, const RememberedShape& memory) {
  Sums sums = Sums::Zero(innovations.rows(), kColumns);
  for (Eigen::Index v = 0; v < innovations.rows(); ++v) {
    if (!innovations.row(v).allFinite()) continue;
    sums(v, kNow) = innovations.row(v).squaredNorm();
    sums(v, kBefore) = memory.innovations.row(v).squaredNorm();
    sums(v, kProduct) = innovations.row(v).dot(memory.innovations.row(v));
    sums(v, kCount) = 1.0;
    const Eigen::RowVector3d difference = thirdDifference(v, measured, memory.measured);
    if (!difference.allFinite()) continue;
    sums(v, kDifference) = difference.squaredNorm();
    sums(v, kDifferenceCount) = 1.0;
  }
  return sums;
}

/// Process noise over the noise of a frame, as this frame's innovations show it. @param frames of the memory.
/// @param noise mean square of a frame's places.
double motionOf(const Eigen::Matrix<double, 1, kColumns>& sums, double frames, double noise) {
  if (frames <= 0.0 || sums[kCount] <= 0.0) return 0.0;
  const double moved = std::max(0.0, sums[kNow] / sums[kCount] / noise - 1.0 - 1.0 / frames);
  if (sums[kProduct] <= 0.0) return moved;
  // A gain of the autocorrelation.
  const double correlation = std::min(1.0, sums[kProduct] / std::sqrt(sums[kNow] * sums[kBefore]));
  return std::max(moved, 1.0 / std::max(1e-9, 1.0 / correlation - 1.0) - 1.0 / frames);
}

double framesAt(const MaterialPoint& place, const Tets& tets, const Eigen::VectorXd& frames) {
  double sum = 0.0, weights = 0.0;
  for (int k = 0; k < 4; ++k) {
    const double weight = std::max(0.0, place.barycentric[k]);
    sum += weight * frames[tets(place.tet, k)];
    weights += weight;
  }
  return sum / weights;
}

}  // namespace

/// Of the places that a frame measures, relative to the last shape.
struct ShapeMemory::Innovations {
  Eigen::VectorXd is_measured;  ///< #V: 1 for a vertex with targets, else 0
  Points around;  ///< #V by 3: means around each vertex; not a number where nothing is measured [m]
};

ShapeMemory::Innovations ShapeMemory::innovationsOf(const std::vector<Target>& targets,
                                                    const Points& vertices) const {
  Eigen::Matrix<double, Eigen::Dynamic, 4, Eigen::RowMajor> sums(vertices.rows(), 4);
  sums.setZero();
  for (const Target& target : targets) {
    if (target.kind == TargetKind::kPrior) continue;
    Eigen::RowVector4d term(0.0, 0.0, 0.0, target.weight);
    term.head<3>() = target.weight * residualOf(target, tets_, vertices);
    for (int k = 0; k < 4; ++k)
      sums.row(tets_(target.place.tet, k)) += std::max(0.0, target.place.barycentric[k]) * term;
  }
  Innovations innovations;
  innovations.is_measured = (sums.col(3).array() > 0.0).cast<double>();
  sumAround(tets_, &sums);
  innovations.around = sums.leftCols<3>().array().colwise() / sums.col(3).array();
  return innovations;
}

void ShapeMemory::adapt(const Innovations& innovations, const Points& vertices, double elapsed_s,
                        RememberedShape* memory) const {
  const double keep = std::exp(-elapsed_s / memory_s_), motion_keep = std::exp(-elapsed_s / kMotion_s);
  const Points measured = vertices + innovations.around;
  Sums sums = sumsOf(innovations.around, measured, *memory);
  sumAround(tets_, &sums);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    auto noise = memory->noise.row(v);
    noise = keep * noise + sums.row(v).segment<2>(kDifference);
    double& variance = memory->variance[v];
    if (noise[1] > 0.0)
      variance = std::min(variance / std::pow(keep, 1.0 / kHold), noise[0] / (20.0 * noise[1]));
    double& frames = memory->frames[v];
    double& motion = memory->motion[v];
    const bool is_known = variance > 0.0 && std::isfinite(variance);
    motion = std::max(motion_keep * motion, is_known ? motionOf(sums.row(v), frames, variance) : 0.0);
    if (innovations.is_measured[v] > 0.0) frames = is_known ? frames / (1.0 + frames * motion) : 0.0;
  }
  memory->innovations = innovations.around.array().isFinite().select(innovations.around, 0.0);
  std::rotate(memory->measured.begin(), memory->measured.end() - 1, memory->measured.end());
  memory->measured[0] = measured;
}

const std::vector<Target>& ShapeMemory::recall(const std::vector<Target>& targets, const Points& vertices,
                                               double elapsed_s, RememberedShape* memory,
                                               std::vector<Target>* means) const {
  if (memory_s_ <= 0.0 || elapsed_s <= 0.0 || targets.empty()) return targets;
  if (memory->frames.size() != vertices.rows()) forget(vertices.rows(), memory);
  const double keep = std::exp(-elapsed_s / memory_s_);
  const Innovations innovations = innovationsOf(targets, vertices);
  adapt(innovations, vertices, elapsed_s, memory);
  *means = targets;
  for (Target& target : *means) {
    if (target.kind == TargetKind::kPrior) continue;
    const double frames = framesAt(target.place, tets_, memory->frames);
    target.position -= frames / (1.0 + frames) * residualOf(target, tets_, vertices);
  }
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    memory->frames[v] = keep * (memory->frames[v] + innovations.is_measured[v]);
  return *means;
}

}  // namespace softbody
