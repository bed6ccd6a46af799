#include "softbody_sim/mean_value_coordinates.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <stdexcept>
#include <utility>

namespace softbody {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Turns of a product of complex numbers around 0, without an arctangent: a turn is complete where two
/// factors of like sign meet on the other side.
class TurnCounter {
 public:
  void multiply(const std::complex<double>& factor) {
    const double magnitude = std::abs(factor);
    if (magnitude == 0.0) return;
    const std::complex<double> next = product_ * factor / magnitude;
    if (product_.imag() >= 0.0 && factor.imag() >= 0.0 && next.imag() < 0.0) ++turns_;
    if (product_.imag() < 0.0 && factor.imag() < 0.0 && next.imag() >= 0.0) --turns_;
    product_ = next;
  }
  int turns() const { return turns_; }

 private:
  std::complex<double> product_{1.0, 0.0};
  int turns_ = 0;
};

}  // namespace

MeanValueCage::MeanValueCage(const Points& vertices, const Triangles& triangles)
    : vertices_(vertices),
      size_((vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm()),
      used_(static_cast<std::size_t>(vertices.rows()), false),
      directions_(vertices.rows(), 3),
      distances_(vertices.rows()) {
  std::map<std::pair<int, int>, int> edge_numbers;
  std::vector<int> balance;  // uses forwards minus uses backwards
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    Face face{};
    for (int k = 0; k < 3; ++k) {
      const int a = triangles(f, k), b = triangles(f, (k + 1) % 3);
      if (a < 0 || a >= vertices.rows()) {
        throw std::invalid_argument(fmt::format("triangle {} names vertex {} of {}", f, a, vertices.rows()));
      }
      const auto [entry, is_new] =
          edge_numbers.try_emplace(std::minmax(a, b), static_cast<int>(edges_.size()));
      if (is_new) {
        edges_.push_back({std::min(a, b), std::max(a, b)});
        balance.push_back(0);
      }
      face.corners[k] = a;
      face.edges[k] = entry->second;
      face.signs[k] = a < b ? 1.0 : -1.0;
      balance[entry->second] += a < b ? 1 : -1;
      used_[a] = true;
    }
    faces_.push_back(face);
  }
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    if (balance[e] != 0) {
      throw std::invalid_argument(fmt::format("the surface is not closed at the edge of vertices {} and {}",
                                              edges_[e].from, edges_[e].to));
    }
  }
}

int MeanValueCage::coordinates(const Eigen::Vector3d& point, Eigen::Ref<Eigen::VectorXd> weights) {
  weights.setZero();
  if (onVertex(point, weights)) return 1;
  measureEdges();
  TurnCounter half_solid_angle;
  for (const Face& face : faces_) {
    double determinant = 0.0;
    const Relation relation = relate(face, &determinant);
    if (relation == Relation::kOnFace) {
      interpolateOnFace(face, weights);
      return 1;
    }
    // tan(solid angle / 2) of a triangle (van Oosterom and Strackee 1983).
    const double cosines =
        edges_[face.edges[0]].cosine + edges_[face.edges[1]].cosine + edges_[face.edges[2]].cosine;
    half_solid_angle.multiply({1.0 + cosines, determinant});
    if (relation == Relation::kApart) addFace(face, determinant, weights);
  }
  weights /= weights.sum();
  return half_solid_angle.turns();
}

/// Directions and distances to all corners; true, with the weights, on one of them.
bool MeanValueCage::onVertex(const Eigen::Vector3d& point, Eigen::Ref<Eigen::VectorXd> weights) {
  for (Eigen::Index v = 0; v < vertices_.rows(); ++v) {
    if (!used_[v]) continue;
    const Eigen::RowVector3d offset = vertices_.row(v) - point.transpose();
    distances_[v] = offset.norm();
    if (distances_[v] <= 1e-10 * size_) {
      weights[v] = 1.0;
      return true;
    }
    directions_.row(v) = offset / distances_[v];
  }
  return false;
}

void MeanValueCage::measureEdges() {
  for (Edge& edge : edges_) {
    const Eigen::Vector3d a = directions_.row(edge.from), b = directions_.row(edge.to);
    edge.cross = a.cross(b);
    edge.cosine = a.dot(b);
    const double sine = edge.cross.norm();
    edge.half_angle = 0.5 * std::atan2(sine, edge.cosine);
    // The ratio tends to 1/2 with the angle; at an angle of pi the point is on the edge, which is dealt with
    // elsewhere.
    edge.mean_normal = (sine > 1e-12 ? edge.half_angle / sine : 0.5) * edge.cross;
  }
}

/// @param determinant of the three unit directions: six times the volume that they span.
MeanValueCage::Relation MeanValueCage::relate(const Face& face, double* determinant) const {
  const Edge& first = edges_[face.edges[0]];
  *determinant = face.signs[0] * first.cross.dot(directions_.row(face.corners[2]));
  if (std::abs(*determinant) > 1e-4) return Relation::kApart;
  // The angles around a point on the face sum to 2 pi; they fall short of it quadratically with the distance.
  const double half_angles =
      first.half_angle + edges_[face.edges[1]].half_angle + edges_[face.edges[2]].half_angle;
  if (kPi - half_angles < 4e-12) return Relation::kOnFace;
  return std::abs(*determinant) > 1e-12 ? Relation::kApart : Relation::kOnPlane;
}

/// Twice the areas of the triangles that the point spans with the edges.
void MeanValueCage::interpolateOnFace(const Face& face, Eigen::Ref<Eigen::VectorXd> weights) const {
  weights.setZero();
  for (int k = 0; k < 3; ++k) {
    const int a = face.corners[(k + 1) % 3], b = face.corners[(k + 2) % 3];
    weights[face.corners[k]] = edges_[face.edges[(k + 1) % 3]].cross.norm() * distances_[a] * distances_[b];
  }
  weights /= weights.sum();
}

/// The triangle's mean vector m = sum theta/2 n over its edges is also sum w_k (p_k - x); take it apart.
void MeanValueCage::addFace(const Face& face, double determinant, Eigen::Ref<Eigen::VectorXd> weights) const {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) mean += face.signs[k] * edges_[face.edges[k]].mean_normal;
  for (int k = 0; k < 3; ++k) {
    const int opposite = (k + 1) % 3;
    const double share = face.signs[opposite] * edges_[face.edges[opposite]].cross.dot(mean);
    weights[face.corners[k]] += share / (distances_[face.corners[k]] * determinant);
  }
}

Eigen::MatrixXd meanValueCoordinates(const Points& points, const Points& cage_vertices,
                                     const Triangles& cage_triangles) {
  MeanValueCage cage(cage_vertices, cage_triangles);
  Eigen::MatrixXd weights(points.rows(), cage_vertices.rows());
  Eigen::VectorXd row(cage_vertices.rows());
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    cage.coordinates(points.row(p), row);
    weights.row(p) = row;
  }
  return weights;
}

}  // namespace softbody
