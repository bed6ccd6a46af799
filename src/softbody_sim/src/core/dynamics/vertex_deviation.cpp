#include "dynamics/vertex_deviation.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/tet_geometry.h"
#include "tets/tet_shape.h"

namespace softbody {
namespace {

// Weight of targets from which a vertex counts as measured in a direction; as in VertexConfidence.
constexpr double kEnough = 0.25;
// The constants below were fitted to the errors of thirteen scenes of the virtual camera; `make evaluate`
// shows how well they hold. Smallest standard deviation [m]: the resolution of the meshes.
constexpr double kSmallest = 1.5e-4;
// Standard deviation of a measured vertex, in root mean squares of the targets' residuals.
constexpr double kNoise = 1.45;
// Strain of a body that looks undeformed.
constexpr double kRestStrain = 0.0005;
// Error for each metre over which the simulation carries a position, for a strain of 1: to vertices that are
// measured in no direction, and along a surface that is measured across only.
constexpr double kAcross = 0.25, kAlong = 0.26;
// Largest distance along the surface [m]; a piece may be measured in one direction only.
constexpr double kFarthest = 0.3;

}  // namespace

VertexDeviation::VertexDeviation(const TetTopology& topology)
    : tets_(topology.tets),
      volumes_(tetVolumes(topology.rest_vertices, topology.tets)),
      edges_(topology.rest_vertices, topology.tets),
      information_(static_cast<std::size_t>(topology.rest_vertices.rows())),
      misfit_(topology.rest_vertices.rows(), 3),
      weight_(information_.size()),
      measured_(information_.size()),
      fixed_(information_.size()) {
  for (const auto& tet : tets_.rowwise())
    rest_inverse_.push_back(edgesOf(topology.rest_vertices, tet).inverse());
  to_measured_.reserve(information_.size());
  to_fixed_.reserve(information_.size());
}

void VertexDeviation::gather(const std::vector<Target>& targets, const Points& vertices) {
  std::fill(information_.begin(), information_.end(), Eigen::Matrix3d::Zero());
  std::fill(weight_.begin(), weight_.end(), 0.0);
  misfit_.setZero();
  double squares = 0.0, sum = 0.0;
  for (const Target& target : targets) {
    if (target.kind == TargetKind::kPrior) continue;
    Eigen::Vector3d residual = target.position;
    for (int k = 0; k < 4; ++k)
      residual -= target.place.barycentric[k] * vertices.row(tets_(target.place.tet, k)).transpose();
    const bool all = target.normal.isZero();
    if (!all) residual = target.normal.dot(residual) * target.normal;
    squares += target.weight * residual.squaredNorm();
    sum += target.weight;
    for (int k = 0; k < 4; ++k) {
      const auto v = static_cast<std::size_t>(tets_(target.place.tet, k));
      const double weight = target.weight * std::max(0.0, target.place.barycentric[k]);
      if (all)
        information_[v].diagonal().array() += weight;
      else
        information_[v] += weight * target.normal * target.normal.transpose();
      misfit_.row(static_cast<Eigen::Index>(v)) += weight * residual.transpose();
      weight_[v] += weight;
    }
  }
  noise_ = sum > 0.0 ? std::sqrt(squares / sum) : 0.0;
}

/// Root mean square of the Green strain over the body.
double VertexDeviation::strain(const Points& vertices) const {
  double sum = 0.0;
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    const Eigen::Matrix3d F = edgesOf(vertices, tets_.row(t)) * rest_inverse_[static_cast<std::size_t>(t)];
    sum += volumes_[t] * 0.25 * (F.transpose() * F - Eigen::Matrix3d::Identity()).squaredNorm();
  }
  return std::sqrt(sum / volumes_.sum());
}

void VertexDeviation::compute(const std::vector<Target>& targets, const Points& vertices,
                              std::vector<float>* deviation) {
  gather(targets, vertices);
  for (std::size_t v = 0; v < information_.size(); ++v) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(information_[v], Eigen::EigenvaluesOnly);
    measured_[v] = eigen.eigenvalues()[2] >= kEnough ? 1 : 0;
    fixed_[v] = eigen.eigenvalues()[0] >= 0.2 * kEnough ? 1 : 0;
  }
  edges_.fromNearest(measured_, &to_measured_);
  edges_.fromNearest(fixed_, &to_fixed_);
  const double carried = kRestStrain + strain(vertices);
  deviation->resize(information_.size());
  for (std::size_t v = 0; v < information_.size(); ++v) {
    const double misfit =
        weight_[v] > 0.0 ? misfit_.row(static_cast<Eigen::Index>(v)).norm() / weight_[v] : 0.0;
    const double along = std::min(to_fixed_[v], kFarthest);
    const double extrapolated = carried * (kAcross * to_measured_[v] + kAlong * along);
    const double result = std::sqrt(kSmallest * kSmallest + kNoise * kNoise * noise_ * noise_ +
                                    misfit * misfit + extrapolated * extrapolated);
    (*deviation)[v] = static_cast<float>(std::min(result, kUnknown_m));
  }
}

void fadeUnobserved(double elapsed_s, MeshState* state) {
  constexpr double kHalfLife_s = 0.5;
  const auto fade = static_cast<float>(std::pow(0.5, elapsed_s / kHalfLife_s));
  for (float& confidence : state->confidence) confidence *= fade;
  // The variance goes to that of a vertex of which nothing is known.
  constexpr float kUnknown = VertexDeviation::kUnknown_m * VertexDeviation::kUnknown_m;
  for (float& deviation : state->standard_deviation)
    deviation = std::sqrt(fade * deviation * deviation + (1.0f - fade) * kUnknown);
}

}  // namespace softbody
