#pragma once

#include <random>

#include "core/cutting/cut_patch.h"
#include "softbody_common/types.h"

namespace softbody::testing {

/// Cuts as they may come, and as they are made on purpose through what a mesh consists of.
enum class CutKind {
  kPlane,            ///< through the whole body
  kPartialPlane,     ///< ends inside
  kSweptBlade,       ///< ruled between poses of a polyline, through the body or not
  kThroughVertices,  ///< a plane through three vertices
  kThroughEdge,      ///< a plane that contains an edge
  kThroughFace,      ///< a plane that contains a triangle
  kGrazing,          ///< a plane at a vertex that lies outermost in its direction
  kCornerAtVertex,   ///< a patch whose corners are vertices
  kCount
};

class RandomPatches {
 public:
  RandomPatches(const Points& vertices, const Triangles& triangles, unsigned seed)
      : vertices_(vertices), triangles_(triangles), random_(seed) {
    low_ = vertices.colwise().minCoeff();
    high_ = vertices.colwise().maxCoeff();
    size_ = (high_ - low_).norm();
  }

  CutPatch next(CutKind kind) {
    switch (kind) {
      case CutKind::kPlane:
        return square(inside(), direction(), size_, 1.0);
      case CutKind::kPartialPlane:
        return square(inside(), direction(), size_, uniform(0.0, 0.5));
      case CutKind::kSweptBlade:
        return sweep();
      case CutKind::kThroughVertices: {
        const Eigen::Vector3d a = vertex(), b = vertex(), c = vertex();
        return square(a, (b - a).cross(c - a), size_, uniform(0.3, 1.0));
      }
      case CutKind::kThroughEdge: {
        const auto t = triangle();
        const Eigen::Vector3d a = at(triangles_(t, 0));
        return square(a, (at(triangles_(t, 1)) - a).cross(direction()), size_, uniform(0.3, 1.0));
      }
      case CutKind::kThroughFace: {
        const auto t = triangle();
        const Eigen::Vector3d a = at(triangles_(t, 0));
        return square(a, (at(triangles_(t, 1)) - a).cross(at(triangles_(t, 2)) - a), size_,
                      uniform(0.3, 1.0));
      }
      case CutKind::kGrazing: {
        const Eigen::Vector3d normal = direction();
        Eigen::Index outermost = 0;
        (vertices_ * normal).maxCoeff(&outermost);
        return square(vertices_.row(outermost), normal, size_, 1.0);
      }
      default: {
        CutPatch patch;
        patch.vertices.resize(4, 3);
        for (int k = 0; k < 3; ++k) patch.vertices.row(k) = vertex().transpose();
        patch.vertices.row(3) = (vertex() + 0.3 * size_ * direction()).transpose();
        patch.triangles.resize(2, 3);
        patch.triangles << 0, 1, 2, 0, 2, 3;
        return patch;
      }
    }
  }

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

 private:
  Eigen::Vector3d at(int v) const { return vertices_.row(v); }
  Eigen::Vector3d vertex() {
    return at(std::uniform_int_distribution<int>(0, static_cast<int>(vertices_.rows()) - 1)(random_));
  }
  Eigen::Index triangle() {
    return std::uniform_int_distribution<Eigen::Index>(0, triangles_.rows() - 1)(random_);
  }
  Eigen::Vector3d direction() {
    std::normal_distribution<double> normal;
    return Eigen::Vector3d(normal(random_), normal(random_), normal(random_)).normalized();
  }
  Eigen::Vector3d inside() {
    return low_ + (high_ - low_).cwiseProduct(Eigen::Vector3d(uniform(0, 1), uniform(0, 1), uniform(0, 1)));
  }

  /// A square round a point; its border to one side is `reach` of the half width away.
  CutPatch square(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double half_width,
                  double reach) {
    const Eigen::Vector3d x = normal.cross(direction()).normalized(), y = normal.normalized().cross(x);
    CutPatch patch;
    patch.vertices.resize(4, 3);
    patch.vertices << (center - half_width * x - half_width * y).transpose(),
        (center + reach * half_width * x - half_width * y).transpose(),
        (center + reach * half_width * x + half_width * y).transpose(),
        (center - half_width * x + half_width * y).transpose();
    patch.triangles.resize(2, 3);
    patch.triangles << 0, 1, 2, 0, 2, 3;
    return patch;
  }

  /// A blade's straight or bent leading edge from outside into the body or through it, turning on the way.
  CutPatch sweep() {
    const Eigen::Vector3d travel = direction(), across = travel.cross(direction()).normalized();
    const Eigen::Vector3d target = inside(), normal = travel.cross(across), axis = direction();
    const int points = std::uniform_int_distribution<int>(2, 4)(random_);
    const int frames = std::uniform_int_distribution<int>(1, 8)(random_);
    const double turn = uniform(0.0, 0.6), bend = uniform(0.0, 0.1), length = size_ * uniform(0.2, 1.2);
    const double way = size_ * uniform(0.8, 2.4);
    const auto edge = [&](int frame) {
      const double time = static_cast<double>(frame) / frames;
      const Eigen::AngleAxisd rotation(turn * (time - 0.5), axis);
      const Eigen::Vector3d middle = target + (way * time - 0.8 * size_) * travel;
      Points leading(points, 3);
      for (int k = 0; k < points; ++k) {
        const double s = static_cast<double>(k) / (points - 1) - 0.5;
        leading.row(k) = middle + rotation * (length * s * across + size_ * bend * (4.0 * s * s) * normal);
      }
      return leading;
    };
    CutPatch patch;
    for (int frame = 0; frame < frames; ++frame) {
      const CutPatch part = ruledPatch(edge(frame), edge(frame + 1));
      const auto vertices = patch.vertices.rows(), triangles = patch.triangles.rows();
      patch.vertices.conservativeResize(vertices + part.vertices.rows(), Eigen::NoChange);
      patch.vertices.bottomRows(part.vertices.rows()) = part.vertices;
      patch.triangles.conservativeResize(triangles + part.triangles.rows(), Eigen::NoChange);
      patch.triangles.bottomRows(part.triangles.rows()) = part.triangles.array() + static_cast<int>(vertices);
    }
    return patch;
  }

  Points vertices_;
  Triangles triangles_;
  std::mt19937 random_;
  Eigen::Vector3d low_, high_;
  double size_ = 0.0;
};

}  // namespace softbody::testing
