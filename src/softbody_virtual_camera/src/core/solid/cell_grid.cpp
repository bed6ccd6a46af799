#include "solid/cell_grid.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

namespace softbody::virtual_camera {
namespace {

constexpr int kHalf = 3;              // samples along half an edge of a cell
constexpr int kSamples = 2 * kHalf;   // along an edge
constexpr double kLeastShare = 1e-3;  // of a cell, so that all its corners are held

using Index3 = Eigen::Vector3i;

/// Where vertical lines through the samples enter and leave the body.
class Columns {
 public:
  Columns(const TriangleMesh& body, const Eigen::Vector3d& low, const Eigen::Vector3d& step,
          const Index3& count)
      : low_(low), step_(step), count_(count), crossings_(static_cast<std::size_t>(count.x() * count.y())) {
    for (Eigen::Index f = 0; f < body.triangles.rows(); ++f)
      add(body.vertices(body.triangles.row(f).transpose(), Eigen::all));
  }

  bool inside(const Index3& sample) const {
    const double z = low_.z() + (sample.z() + 0.5) * step_.z();
    const std::vector<double>& heights =
        crossings_[static_cast<std::size_t>(sample.x() * count_.y() + sample.y())];
    return std::count_if(heights.begin(), heights.end(), [z](double height) { return height < z; }) % 2 == 1;
  }

 private:
  /// The columns are a little aside of the samples, so that none meets an edge.
  double place(int axis, int column) const {
    return low_[axis] + (column + 0.5 + (axis == 0 ? 1.3e-4 : 2.9e-4)) * step_[axis];
  }

  int firstAfter(int axis, double value) const {
    return std::max(0, static_cast<int>(std::floor((value - low_[axis]) / step_[axis])) - 1);
  }

  void add(const Eigen::Matrix3d& corners) {
    Eigen::Matrix3d flat = corners.transpose();
    flat.row(2).setOnes();
    if (std::abs(flat.determinant()) < 1e-18) return;
    const Eigen::Matrix3d weights_of = flat.inverse();
    const Eigen::RowVector3d least = corners.colwise().minCoeff(), most = corners.colwise().maxCoeff();
    for (int i = firstAfter(0, least.x()); i < count_.x() && place(0, i) <= most.x(); ++i) {
      for (int j = firstAfter(1, least.y()); j < count_.y() && place(1, j) <= most.y(); ++j) {
        const Eigen::Vector3d weights = weights_of * Eigen::Vector3d(place(0, i), place(1, j), 1.0);
        if (weights.minCoeff() < 0.0) continue;
        crossings_[static_cast<std::size_t>(i * count_.y() + j)].push_back(corners.col(2).dot(weights));
      }
    }
  }

  Eigen::Vector3d low_, step_;
  Index3 count_;
  std::vector<std::vector<double>> crossings_;
};

/// Shares of the eight parts of a cell that are inside.
std::array<double, 8> sharesInside(const Columns& columns, const Index3& cell) {
  std::array<double, 8> shares{};
  for (int i = 0; i < kSamples; ++i) {
    for (int j = 0; j < kSamples; ++j) {
      for (int k = 0; k < kSamples; ++k) {
        const auto part = static_cast<std::size_t>(4 * (i / kHalf) + 2 * (j / kHalf) + k / kHalf);
        if (columns.inside(kSamples * cell + Index3(i, j, k))) shares[part] += 1.0 / (kHalf * kHalf * kHalf);
      }
    }
  }
  return shares;
}

Index3 corner(int number) { return {number / 4, number / 2 % 2, number % 2}; }

/// Numbers the corners of the cells, along x first.
void addNodes(const std::vector<Index3>& cells, const Eigen::Vector3d& low, CellGrid* grid) {
  std::map<std::array<int, 3>, int> numbers;
  const auto at = [](const Index3& cell, int number) {
    const Index3 node = cell + corner(number);
    return std::array{node.x(), node.y(), node.z()};
  };
  for (const Index3& cell : cells) {
    for (int c = 0; c < 8; ++c) numbers.emplace(at(cell, c), 0);
  }
  grid->nodes.resize(static_cast<Eigen::Index>(numbers.size()), 3);
  int next = 0;
  for (auto& [node, number] : numbers) {
    number = next++;
    const Eigen::Vector3d steps(node[0], node[1], node[2]);
    grid->nodes.row(number) = (low + steps.cwiseProduct(grid->cell_size)).transpose();
  }
  for (const Index3& cell : cells) {
    std::array<int, 8> corners{};
    for (int c = 0; c < 8; ++c) corners[static_cast<std::size_t>(c)] = numbers.at(at(cell, c));
    grid->cells.push_back(corners);
  }
}

}  // namespace

Eigen::Vector3d Embedding::in(const Points& all) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 8; ++k) sum += weights[k] * all.row(nodes[k]).transpose();
  return sum;
}

std::array<double, 8> cornerWeights(const Eigen::Vector3d& place) {
  std::array<double, 8> weights{};
  for (int k = 0; k < 8; ++k) {
    const Eigen::Array3d far = corner(k).cast<double>();
    weights[static_cast<std::size_t>(k)] = (far * place.array() + (1.0 - far) * (1.0 - place.array())).prod();
  }
  return weights;
}

Embedding CellGrid::embed(const Eigen::Vector3d& rest) const {
  double nearest = 1e9;
  Embedding best;
  Eigen::Vector3d place;
  for (const std::array<int, 8>& cell : cells) {
    const Eigen::Vector3d relative = (rest - nodes.row(cell[0]).transpose()).cwiseQuotient(cell_size);
    const double distance = (relative - relative.cwiseMax(0.0).cwiseMin(1.0)).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    place = relative;
    best.nodes = cell;
    if (distance == 0.0) break;
  }
  best.weights = cornerWeights(place);
  return best;
}

CellGrid fillWithCells(const TriangleMesh& body, double size_m) {
  return fillWithCells(body, Eigen::Vector3d::Constant(size_m));
}

CellGrid fillWithCells(const TriangleMesh& body, const Eigen::Vector3d& size_m) {
  const Eigen::Vector3d low = body.vertices.colwise().minCoeff();
  const Eigen::Vector3d extent = body.vertices.colwise().maxCoeff().transpose() - low;
  const Index3 count =
      (extent.cwiseQuotient(size_m) - Eigen::Vector3d::Constant(1e-9)).array().ceil().cast<int>();
  CellGrid grid;
  grid.cell_size = extent.cwiseQuotient(count.cast<double>());
  const Columns columns(body, low, grid.cell_size / kSamples, kSamples * count);
  std::vector<Index3> kept;
  for (int i = 0; i < count.x(); ++i) {
    for (int j = 0; j < count.y(); ++j) {
      for (int k = 0; k < count.z(); ++k) {
        std::array<double, 8> volumes = sharesInside(columns, {i, j, k});
        if (*std::max_element(volumes.begin(), volumes.end()) == 0.0) continue;
        for (double& volume : volumes) volume = std::max(volume, kLeastShare) * grid.cell_size.prod() / 8.0;
        grid.volumes.push_back(volumes);
        kept.emplace_back(i, j, k);
      }
    }
  }
  addNodes(kept, low, &grid);
  return grid;
}

}  // namespace softbody::virtual_camera
