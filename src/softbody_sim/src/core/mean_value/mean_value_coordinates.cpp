#include "softbody_sim/mean_value/mean_value_coordinates.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "mean_value/mean_value_kernel.h"

namespace softbody {
namespace {

/// Numbers the edges. @throw std::invalid_argument, see MeanValueCage.
class CageBuilder {
 public:
  CageBuilder(const Points& vertices, const Triangles& triangles) {
    mesh_.vertices = vertices;
    mesh_.size = (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) addFace(f, triangles.row(f));
    for (std::size_t e = 0; e < mesh_.edges.size(); ++e) {
      if (balance_[e] == 0) continue;
      throw std::invalid_argument(fmt::format("the surface is not closed at the edge of vertices {} and {}",
                                              mesh_.edges[e].from, mesh_.edges[e].to));
    }
  }
  CageMesh take() { return std::move(mesh_); }

 private:
  void addFace(Eigen::Index f, const Eigen::RowVector3i& corners) {
    CageMesh::Face face{};
    for (int k = 0; k < 3; ++k) {
      const int a = corners[k], b = corners[(k + 1) % 3];
      if (a < 0 || a >= mesh_.vertices.rows()) {
        throw std::invalid_argument(
            fmt::format("triangle {} refers to vertex {}; there are {}", f, a, mesh_.vertices.rows()));
      }
      face.corners[k] = a;
      face.edges[k] = edgeNumber(a, b);
      face.signs[k] = a < b ? 1.0 : -1.0;
      balance_[static_cast<std::size_t>(face.edges[k])] += a < b ? 1 : -1;
    }
    mesh_.faces.push_back(face);
  }

  int edgeNumber(int a, int b) {
    const auto [entry, is_new] =
        numbers_.try_emplace(std::minmax(a, b), static_cast<int>(mesh_.edges.size()));
    if (is_new) {
      mesh_.edges.push_back({std::min(a, b), std::max(a, b)});
      balance_.push_back(0);
    }
    return entry->second;
  }

  CageMesh mesh_;
  std::map<std::pair<int, int>, int> numbers_;
  std::vector<int> balance_;  ///< forward minus backward uses of each edge
};

/// Barycentric coordinates of a point on a face: the areas of the triangles that it spans with the edges.
void interpolateOnFace(const CageMesh& cage, int f, const Eigen::Vector3d& point,
                       Eigen::Ref<Eigen::RowVectorXd> weights) {
  const int(&corners)[3] = cage.faces[static_cast<std::size_t>(f)].corners;
  weights.setZero();
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d a = cage.vertices.row(corners[(k + 1) % 3]).transpose() - point;
    const Eigen::Vector3d b = cage.vertices.row(corners[(k + 2) % 3]).transpose() - point;
    weights[corners[k]] = a.cross(b).norm();
  }
  weights /= weights.sum();
}

}  // namespace

MeanValueCage::MeanValueCage(const Points& vertices, const Triangles& triangles)
    : mesh_(std::make_unique<const CageMesh>(CageBuilder(vertices, triangles).take())) {}

MeanValueCage::~MeanValueCage() = default;

Eigen::Index MeanValueCage::vertexCount() const { return mesh_->vertices.rows(); }

std::vector<int> MeanValueCage::coordinates(const Points& points, WeightRows* weights) const {
  const auto count = static_cast<std::size_t>(points.rows());
  weights->resize(points.rows(), vertexCount());
  std::vector<int> turns(count);
  std::vector<CageContact> contacts(count);
  meanValueKernel(*mesh_, points.data(), static_cast<int>(count), weights->data(), turns.data(),
                  contacts.data());
  for (std::size_t p = 0; p < count; ++p) {
    const auto [vertex, face] = contacts[p];
    if (vertex < 0 && face < 0) continue;
    const auto row = static_cast<Eigen::Index>(p);
    turns[p] = 1;
    if (vertex < 0) {
      interpolateOnFace(*mesh_, face, points.row(row), weights->row(row));
    } else {
      weights->row(row) = Eigen::RowVectorXd::Unit(vertexCount(), vertex);
    }
  }
  return turns;
}

}  // namespace softbody
