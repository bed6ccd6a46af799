#include "markerless/pose_graph.h"

#include <Eigen/Dense>

namespace softbody::scanning {
namespace {

constexpr int kPlainIterations = 3,
              kAllIterations = 15;  // plain ones close the loop, before outliers count less
constexpr double kPrior = 1e-3;     // of a pose without any edge [1/m^2, 1/rad^2]

struct System {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
};

System systemOf(const std::vector<PoseEdge>& edges, const std::vector<Eigen::Isometry3d>& poses,
                bool robust) {
  const Eigen::Index size = 6 * static_cast<Eigen::Index>(poses.size());
  System s{kPrior * Eigen::MatrixXd::Identity(size, size), Eigen::VectorXd::Zero(size)};
  for (const PoseEdge& edge : edges) {
    const Eigen::Isometry3d T = poses[edge.to] * poses[edge.from].inverse();
    const Vector6 r = motionVector(T * edge.T_to_from.inverse());
    PoseCovariance W = edge.covariance.inverse();
    if (robust) W /= 1.0 + r.dot(W * r) / 6.0;
    const PoseCovariance A = -movedBy(T);
    const Eigen::Index a = 6 * edge.from, b = 6 * edge.to;
    s.H.block<6, 6>(b, b) += W;
    s.H.block<6, 6>(a, a) += A.transpose() * W * A;
    s.H.block<6, 6>(b, a) += W * A;
    s.H.block<6, 6>(a, b) += A.transpose() * W;
    s.g.segment<6>(b) += W * r;
    s.g.segment<6>(a) += A.transpose() * W * r;
  }
  s.H.topLeftCorner<6, 6>().diagonal().array() += 1e15;
  return s;
}

}  // namespace

std::vector<PoseCovariance> adjustPoses(const std::vector<PoseEdge>& edges,
                                        std::vector<Eigen::Isometry3d>* poses) {
  for (int i = 0; i < kAllIterations; ++i) {
    const System s = systemOf(edges, *poses, i >= kPlainIterations);
    const Eigen::VectorXd step = -s.H.llt().solve(s.g);
    for (std::size_t k = 1; k < poses->size(); ++k)
      (*poses)[k] = moved(step.segment<6>(6 * static_cast<Eigen::Index>(k)), (*poses)[k]);
    if (i > kPlainIterations && step.norm() < 1e-6) break;
  }
  const System s = systemOf(edges, *poses, true);
  const Eigen::MatrixXd inverse = s.H.llt().solve(Eigen::MatrixXd::Identity(s.H.rows(), s.H.cols()));
  std::vector<PoseCovariance> covariances;
  for (Eigen::Index k = 0; k < s.H.rows(); k += 6) covariances.emplace_back(inverse.block<6, 6>(k, k));
  return covariances;
}

}  // namespace softbody::scanning
