#pragma once

#include <Eigen/Core>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

/// Mean value coordinates of points with respect to a closed triangle mesh (Ju et al. 2005; Kang et al. 2022,
/// eq. 12-14). Exact on vertices, edges and faces too, where they are the linear interpolation over the
/// triangle.
/// @param points #P by 3 [m], same frame as the cage, inside of it, on it, or outside.
/// @param cage_vertices #C by 3 [m]; those that no triangle uses get the weight 0. @param cage_triangles
/// outward.
/// @return #P by #C, rows sum to 1. @throw std::invalid_argument if the cage is not closed.
Eigen::MatrixXd meanValueCoordinates(const Points& points, const Points& cage_vertices,
                                     const Triangles& cage_triangles);

/// The same for one point after another: finds the cage's edges once.
class MeanValueCage {
 public:
  /// @throw std::invalid_argument if an index is out of range or the triangles are not closed.
  MeanValueCage(const Points& vertices, const Triangles& triangles);

  /// @param weights #C, overwritten; sum 1. @return the cage's winding number around the point: 1 inside or
  /// on the surface, 0 outside.
  int coordinates(const Eigen::Vector3d& point, Eigen::Ref<Eigen::VectorXd> weights);

 private:
  struct Edge {
    int from, to;
    Eigen::Vector3d cross = Eigen::Vector3d::Zero();  ///< u_from x u_to of the unit directions to the corners
    Eigen::Vector3d mean_normal = Eigen::Vector3d::Zero();  ///< half the angle between them, along `cross`
    double half_angle = 0.0;
    double cosine = 1.0;
  };
  /// Edge k runs from corner k to corner k + 1; sign -1: against the stored direction.
  struct Face {
    int corners[3];
    int edges[3];
    double signs[3];
  };
  enum class Relation { kApart, kOnPlane, kOnFace };

  bool onVertex(const Eigen::Vector3d& point, Eigen::Ref<Eigen::VectorXd> weights);
  void measureEdges();
  Relation relate(const Face& face, double* determinant) const;
  void interpolateOnFace(const Face& face, Eigen::Ref<Eigen::VectorXd> weights) const;
  void addFace(const Face& face, double determinant, Eigen::Ref<Eigen::VectorXd> weights) const;

  Points vertices_;
  double size_;  ///< of the bounding box [m]
  std::vector<bool> used_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  Points directions_;          ///< of the current point
  Eigen::VectorXd distances_;  ///< of the current point
};

}  // namespace softbody
