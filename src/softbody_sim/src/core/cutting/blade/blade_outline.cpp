#include "cutting/blade/blade_outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace softbody {
namespace {

/// Newell's normal, unit: the outline runs counter-clockwise about it.
Eigen::Vector3d normalOf(const Points& outline) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = outline.row(0);
  for (Eigen::Index i = 0; i < outline.rows(); ++i) {
    const Eigen::Vector3d a = outline.row(i).transpose() - origin,
                          b = outline.row((i + 1) % outline.rows()).transpose() - origin;
    sum += a.cross(b);
  }
  return sum.normalized();
}

}  // namespace

std::vector<int> partsOfSides(const Points& polygon, double spacing) {
  constexpr double kMostParts = 400.0;  // 1 mm of a blade of 20 cm; each is looked up in the tets
  Eigen::VectorXd lengths(polygon.rows());
  for (Eigen::Index i = 0; i < polygon.rows(); ++i)
    lengths[i] = (polygon.row((i + 1) % polygon.rows()) - polygon.row(i)).norm();
  const double apart = std::max(spacing, lengths.sum() / kMostParts);
  std::vector<int> parts;
  for (const double length : lengths)
    parts.push_back(std::max(1, static_cast<int>(std::ceil(length / apart))));
  return parts;
}

Points sampleOutline(const Points& polygon, const std::vector<int>& parts) {
  Points samples(std::accumulate(parts.begin(), parts.end(), 0), 3);
  Eigen::Index row = 0;
  for (std::size_t side = 0; side < parts.size(); ++side) {
    const auto i = static_cast<Eigen::Index>(side);
    for (int k = 0; k < parts[side]; ++k) {
      const double share = static_cast<double>(k) / parts[side];
      samples.row(row++) = (1.0 - share) * polygon.row(i) + share * polygon.row((i + 1) % polygon.rows());
    }
  }
  return samples;
}

BladeOutline::BladeOutline(Points points, std::vector<int> parts)
    : points_(std::move(points)), parts_(std::move(parts)), normal_(normalOf(points_)) {
  int first = 0;
  for (const int count : parts_) {
    corners_.push_back(first);
    first += count;
  }
  side_normals_.resize(sides(), 3);
  for (int side = 0; side < sides(); ++side) {
    const int from = corners_[side], to = corners_[(side + 1) % sides()];
    const Eigen::Vector3d along = (points_.row(to) - points_.row(from)).transpose();
    side_normals_.row(side) = along.cross(normal_).normalized().transpose();
  }
}

Points BladeOutline::setBack(double distance) const {
  Points back = points_;
  for (int i = 0; i < points_.rows(); ++i) {
    const Eigen::RowVector3d normal = side_normals_.row(sideTo(i)) + side_normals_.row(sideFrom(i));
    back.row(i) -= distance * normal.normalized();
  }
  return back;
}

int BladeOutline::sideFrom(int sample) const {
  const int count = static_cast<int>(points_.rows());
  const auto next_corner = std::upper_bound(corners_.begin(), corners_.end(), sample % count);
  return static_cast<int>(next_corner - corners_.begin()) - 1;
}

int BladeOutline::sideTo(int sample) const { return sideFrom(sample + static_cast<int>(points_.rows()) - 1); }

std::vector<int> BladeOutline::leadingEdge(const Eigen::Vector3d& way) const {
  constexpr double kFacing = 0.6;  // of the cosine of the foremost side: both sides of a tip lead
  const Eigen::VectorXd facing = side_normals_ * way;
  Eigen::Index foremost = 0;
  facing.maxCoeff(&foremost);
  const auto leads = [&](int side) {
    return facing[(side + sides()) % sides()] > kFacing * facing[foremost];
  };
  int first = static_cast<int>(foremost), last = first;
  while (last - first + 1 < sides() && leads(first - 1)) --first;
  while (last - first + 1 < sides() && leads(last + 1)) ++last;
  std::vector<int> edge{corners_[(first + sides()) % sides()]};
  for (int side = first; side <= last; ++side) {
    for (int k = 0; k < parts_[(side + sides()) % sides()]; ++k) edge.push_back(next(edge.back()));
  }
  return edge;
}

Points BladeOutline::outwardNormals(const std::vector<int>& edge) const {
  Points normals(static_cast<Eigen::Index>(edge.size()), 3);
  for (std::size_t i = 0; i < edge.size(); ++i) {
    const int after = sideFrom(edge[std::min(i, edge.size() - 2)]),
              before = sideFrom(edge[i == 0 ? 0 : i - 1]);
    normals.row(static_cast<Eigen::Index>(i)) =
        (side_normals_.row(before) + side_normals_.row(after)).normalized();
  }
  return normals;
}

}  // namespace softbody
