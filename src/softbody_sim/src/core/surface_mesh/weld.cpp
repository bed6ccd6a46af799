#include "surface_mesh/weld.h"

#include <array>
#include <boost/functional/hash.hpp>
#include <cmath>
#include <unordered_map>

namespace softbody {
namespace {

using Cell = std::array<long long, 3>;

/// The vertices so far, in cells of twice the tolerance: all vertices within the tolerance lie in eight
/// cells.
class CoincidenceGrid {
 public:
  explicit CoincidenceGrid(double tolerance) : tolerance_(tolerance) {}

  int find(const Points& vertices, int vertex) const {
    for (int corner = 0; corner < 8; ++corner) {
      Eigen::RowVector3d probe = vertices.row(vertex);
      for (int axis = 0; axis < 3; ++axis)
        probe[axis] += (corner >> axis & 1) != 0 ? tolerance_ : -tolerance_;
      const auto cell = cells_.find(cellOf(probe));
      if (cell == cells_.end()) continue;
      for (const int other : cell->second) {
        if ((vertices.row(other) - vertices.row(vertex)).norm() <= tolerance_) return other;
      }
    }
    return -1;
  }

  void add(const Points& vertices, int vertex) { cells_[cellOf(vertices.row(vertex))].push_back(vertex); }

 private:
  Cell cellOf(const Eigen::RowVector3d& point) const {
    Cell cell{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      cell[axis] = std::llround(std::floor(point[static_cast<int>(axis)] / (2.0 * tolerance_)));
    }
    return cell;
  }

  double tolerance_;
  std::unordered_map<Cell, std::vector<int>, boost::hash<Cell>> cells_;
};

}  // namespace

std::vector<int> firstCoincident(const Points& vertices, double tolerance) {
  CoincidenceGrid grid(tolerance);
  std::vector<int> first(static_cast<std::size_t>(vertices.rows()));
  for (int v = 0; v < static_cast<int>(vertices.rows()); ++v) {
    const int found = grid.find(vertices, v);
    first[static_cast<std::size_t>(v)] = found < 0 ? v : found;
    if (found < 0) grid.add(vertices, v);
  }
  return first;
}

}  // namespace softbody
