#include "alignment/measured_share.h"

#include <Eigen/Dense>
#include <cmath>

namespace softbody {
namespace {

/// Turn and shift have the same unit: the turn is multiplied by the piece's radius [m].
struct PieceInformation {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  double radius = 0.0;
  MotionShare sum = MotionShare::Zero();

  explicit PieceInformation(const Points& vertices)
      : center(vertices.colwise().mean()),
        radius(std::sqrt((vertices.rowwise() - center.transpose()).rowwise().squaredNorm().mean())) {}

  void add(const Association& a) {
    if (!a.normal.isZero(0.0)) return addDistance(a, a.normal);
    for (int k = 0; k < 3; ++k) addDistance(a, Eigen::Vector3d::Unit(k));
  }

  void addDistance(const Association& a, const Eigen::Vector3d& direction) {
    Eigen::Matrix<double, 6, 1> row;
    row << (a.predicted - center).cross(direction) / radius, direction;
    sum.selfadjointView<Eigen::Lower>().rankUpdate(row, a.weight);
  }

  MotionShare share() const {
    const Eigen::SelfAdjointEigenSolver<MotionShare> eigen(sum);
    const Eigen::Array<double, 6, 1> information = eigen.eigenvalues().array().max(0.0);
    const Eigen::Matrix<double, 6, 1> shares = information / (information + 1.0);
    MotionShare result = eigen.eigenvectors() * shares.asDiagonal() * eigen.eigenvectors().transpose();
    result.topRightCorner<3, 3>() /= radius;
    result.bottomLeftCorner<3, 3>() *= radius;
    return result;
  }
};

}  // namespace

std::vector<MotionShare> measuredShares(const std::vector<Association>& associations,
                                        const std::vector<Points>& pieces,
                                        const Eigen::Matrix3d& R_fixed_camera) {
  std::vector<PieceInformation> information(pieces.begin(), pieces.end());
  for (const Association& a : associations) information[a.piece].add(a);
  MotionShare turn = MotionShare::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = R_fixed_camera;
  std::vector<MotionShare> shares;
  shares.reserve(pieces.size());
  for (const PieceInformation& piece : information) shares.push_back(turn * piece.share() * turn.transpose());
  return shares;
}

}  // namespace softbody
