#include "solid/hex_solid.h"

#include <cmath>
#include <utility>

namespace softbody::virtual_camera {

HexSolid::HexSolid(CellGrid grid, const StableNeoHookean& material)
    : grid_(std::move(grid)), material_(material) {
  for (int point = 0; point < 8; ++point) {
    const auto sideOf = [](int number, int axis) { return (number >> (2 - axis)) % 2 == 0 ? -1.0 : 1.0; };
    for (int corner = 0; corner < 8; ++corner) {
      for (int axis = 0; axis < 3; ++axis) {
        double slope = sideOf(corner, axis) / grid_.cell_size[axis];
        for (int other = 0; other < 3; ++other) {
          if (other != axis)
            slope *= 0.5 * (1.0 + sideOf(corner, other) * sideOf(point, other) / std::sqrt(3.0));
        }
        slopes_[static_cast<std::size_t>(point)](axis, corner) = slope;
      }
    }
  }
}

Eigen::VectorXd HexSolid::rest() const {
  return Eigen::Map<const Eigen::VectorXd>(grid_.nodes.data(), unknowns());
}

Eigen::VectorXd HexSolid::nodalVolumes() const {
  const double near = 0.5 * (1.0 - 1.0 / std::sqrt(3.0));  // of a Gauss point, as a share of the edge
  Eigen::VectorXd volumes = Eigen::VectorXd::Zero(grid_.nodes.rows());
  for (int point = 0; point < 8; ++point) {
    const Eigen::Vector3d far(point / 4, point / 2 % 2, point % 2);
    const std::array<double, 8> weights =
        cornerWeights(far * (1.0 - 2.0 * near) + Eigen::Vector3d::Constant(near));
    for (std::size_t cell = 0; cell < grid_.cells.size(); ++cell) {
      for (std::size_t k = 0; k < 8; ++k)
        volumes[grid_.cells[cell][k]] += weights[k] * grid_.volumes[cell][static_cast<std::size_t>(point)];
    }
  }
  return volumes;
}

HexSolid::Corners HexSolid::cornersOf(const Eigen::VectorXd& nodes, std::size_t cell) const {
  Corners corners;
  for (int k = 0; k < 8; ++k)
    corners.col(k) = nodes.segment<3>(3 * grid_.cells[cell][static_cast<std::size_t>(k)]);
  return corners;
}

double HexSolid::energy(const Eigen::VectorXd& nodes) const {
  double sum = 0.0;
  for (std::size_t cell = 0; cell < grid_.cells.size(); ++cell) {
    const Corners corners = cornersOf(nodes, cell);
    for (std::size_t point = 0; point < 8; ++point)
      sum += grid_.volumes[cell][point] * material_.energy(corners * slopes_[point].transpose());
  }
  return sum;
}

void HexSolid::addGradient(const Eigen::VectorXd& nodes, Eigen::VectorXd* gradient) const {
  for (std::size_t cell = 0; cell < grid_.cells.size(); ++cell) {
    const Corners corners = cornersOf(nodes, cell);
    Corners forces = Corners::Zero();
    for (std::size_t point = 0; point < 8; ++point) {
      const Eigen::Matrix3d stress = material_.stress(corners * slopes_[point].transpose());
      forces += grid_.volumes[cell][point] * stress * slopes_[point];
    }
    for (int k = 0; k < 8; ++k)
      gradient->segment<3>(3 * grid_.cells[cell][static_cast<std::size_t>(k)]) += forces.col(k);
  }
}

void HexSolid::addStiffness(const Eigen::VectorXd& nodes, bool positive, Triplets* triplets) const {
  using Matrix24 = Eigen::Matrix<double, 24, 24>;
  for (std::size_t cell = 0; cell < grid_.cells.size(); ++cell) {
    const Corners corners = cornersOf(nodes, cell);
    Matrix24 stiffness = Matrix24::Zero();
    for (std::size_t point = 0; point < 8; ++point) {
      const Eigen::Matrix3d F = corners * slopes_[point].transpose();
      const StableNeoHookean::Matrix9 of_F = material_.stiffnessOf(F, positive);
      Eigen::Matrix<double, 9, 24> F_of_nodes = Eigen::Matrix<double, 9, 24>::Zero();
      for (int k = 0; k < 8; ++k) {
        for (int column = 0; column < 3; ++column)
          F_of_nodes.block<3, 3>(3 * column, 3 * k).diagonal().setConstant(slopes_[point](column, k));
      }
      const Eigen::Matrix<double, 9, 24> product = grid_.volumes[cell][point] * of_F * F_of_nodes;
      stiffness.noalias() += F_of_nodes.transpose() * product;
    }
    for (int i = 0; i < 24; ++i) {
      for (int j = 0; j < 24; ++j) {
        const int row = 3 * grid_.cells[cell][static_cast<std::size_t>(i / 3)] + i % 3,
                  column = 3 * grid_.cells[cell][static_cast<std::size_t>(j / 3)] + j % 3;
        if (row >= column) triplets->emplace_back(row, column, stiffness(i, j));
      }
    }
  }
}

Points asPoints(const Eigen::VectorXd& nodes) {
  return Eigen::Map<const Points>(nodes.data(), nodes.size() / 3, 3);
}

}  // namespace softbody::virtual_camera
