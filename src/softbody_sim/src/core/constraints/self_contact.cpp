#include "constraints/self_contact.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

Eigen::Matrix3d cornersOf(const Triangles& triangles, int triangle, const Points& x) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.col(k) = x.row(triangles(triangle, k));
  return corners;
}

Eigen::Vector3d normalOf(const Eigen::Matrix3d& corners) {
  return (corners.col(1) - corners.col(0)).cross(corners.col(2) - corners.col(0)).normalized();
}

/// Barycentric coordinates of the point's projection onto the triangle's plane.
Eigen::Vector3d weightsOf(const Eigen::Vector3d& point, const Eigen::Matrix3d& corners) {
  Eigen::Matrix<double, 3, 2> edges;
  edges << corners.col(1) - corners.col(0), corners.col(2) - corners.col(0);
  const Eigen::Matrix2d squares = edges.transpose() * edges;
  const Eigen::Vector2d weights = squares.inverse() * (edges.transpose() * (point - corners.col(0)));
  return {1.0 - weights.sum(), weights.x(), weights.y()};
}

void setNormals(const Triangles& triangles, const Points& x, Points* normals) {
  normals->resize(triangles.rows(), 3);
  for (int f = 0; f < triangles.rows(); ++f) normals->row(f) = normalOf(cornersOf(triangles, f, x));
}

}  // namespace

SelfContact::SelfContact(const TetTopology& topology, const Options& options)
    : topology_(&topology),
      options_(options),
      piece_of_vertex_(static_cast<std::size_t>(topology.rest_vertices.rows())) {
  const std::vector<std::vector<int>> pieces = verticesOfPieces(topology.tets, topology.rest_vertices.rows());
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (const int v : pieces[p]) piece_of_vertex_[static_cast<std::size_t>(v)] = p;
  piece_boxes_.resize(pieces.size());
}

void SelfContact::start(const std::vector<ContactPoint>& points, const Points& before) {
  if (piece_of_point_.empty()) sortPoints(points);
  if (!clearance_.isSet()) measureClearance(points, topology_->rest_vertices);
  at_start_m_ = clearance_.at(before);
  // Measuring costs a search. It is done only when the shape has used up half of the room.
  if (2.0 * (at_start_m_ - options_.reach_m) < clearance_.measured() - options_.reach_m) {
    measureClearance(points, before);
    at_start_m_ = clearance_.measured();
  }
}

bool SelfContact::mayTouch(const Points& before, const Points& now) {
  parts_near_ = std::min(at_start_m_, clearance_.at(now)) < options_.reach_m;
  if (piece_boxes_.size() < 2) return parts_near_;
  for (Box& box : piece_boxes_) box.setEmpty();
  for (std::size_t v = 0; v < piece_of_vertex_.size(); ++v) {
    const auto row = static_cast<Eigen::Index>(v);
    piece_boxes_[piece_of_vertex_[v]].extend(before.row(row).transpose()).extend(now.row(row).transpose());
  }
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(options_.reach_m);
  for (Box& box : piece_boxes_) box = Box(box.min() - margin, box.max() + margin);
  for (std::size_t p = 0; p < piece_boxes_.size(); ++p)
    if (isNear(p, piece_boxes_[p])) return true;
  return parts_near_;
}

/// Whether the box of another piece meets this one.
bool SelfContact::isNear(std::size_t piece, const Box& box) const {
  for (std::size_t q = 0; q < piece_boxes_.size(); ++q)
    if (q != piece && piece_boxes_[q].intersects(box)) return true;
  return false;
}

/// The triangles around each point.
void SelfContact::sortPoints(const std::vector<ContactPoint>& points) {
  tet_of_triangle_ = tetsOfSurface(*topology_);
  triangles_.reserve(tet_of_triangle_.size());
  triangle_boxes_.reserve(tet_of_triangle_.size());
  grid_.reserve(tet_of_triangle_.size());
  std::vector<std::vector<int>> around(piece_of_vertex_.size());
  for (int f = 0; f < topology_->surface.rows(); ++f)
    for (int k = 0; k < 3; ++k) around[static_cast<std::size_t>(topology_->surface(f, k))].push_back(f);
  for (const ContactPoint& point : points) {  // the triangles that have all vertices with weight
    std::vector<int> common;
    bool first = true;
    for (int k = 0; k < 4; ++k) {
      if (point.place.barycentric[k] == 0.0) continue;
      const std::vector<int>& next = around[static_cast<std::size_t>(topology_->tets(point.place.tet, k))];
      std::vector<int> both;
      std::set_intersection(common.begin(), common.end(), next.begin(), next.end(), std::back_inserter(both));
      common = first ? next : both;
      first = false;
    }
    triangles_of_point_.push_back(common);
    setNeighbors(triangles_of_point_.size() - 1, around);
    piece_of_point_.push_back(
        piece_of_vertex_[static_cast<std::size_t>(topology_->tets(point.place.tet, 0))]);
  }
}

void SelfContact::setNeighbors(std::size_t point, const std::vector<std::vector<int>>& around) {
  std::vector<int> neighbors;
  for (const int own : triangles_of_point_[point]) {
    for (int k = 0; k < 3; ++k) {
      const std::vector<int>& next = around[static_cast<std::size_t>(topology_->surface(own, k))];
      neighbors.insert(neighbors.end(), next.begin(), next.end());
    }
  }
  std::sort(neighbors.begin(), neighbors.end());
  neighbors.erase(std::unique(neighbors.begin(), neighbors.end()), neighbors.end());
  neighbors_of_point_.push_back(neighbors);
}

bool SelfContact::isNeighbor(std::size_t point, int triangle) const {
  const std::vector<int>& neighbors = neighbors_of_point_[point];
  return std::binary_search(neighbors.begin(), neighbors.end(), triangle);
}

/// Parts of a piece that are not neighbours and not separated by its inside.
void SelfContact::measureClearance(const std::vector<ContactPoint>& points, const Points& x) {
  const double farthest = options_.deepest_m;
  setNormals(topology_->surface, x, &normals_);
  triangle_boxes_.clear();
  for (int f = 0; f < topology_->surface.rows(); ++f) {
    Box box;
    for (int k = 0; k < 3; ++k) box.extend(x.row(topology_->surface(f, k)).transpose());
    triangle_boxes_.emplace_back(box.min().array() - farthest, box.max().array() + farthest);
  }
  grid_.set(triangle_boxes_);
  double least = farthest;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Eigen::Vector3d point = positionOf(points[p].place, x, topology_->tets);
    grid_.visit(Box(point), [&](int f) {
      const Eigen::Vector3d corner = x.row(topology_->surface(f, 0));
      if (normals_.row(f).dot(point - corner) < -options_.largest_m || isOfOtherPiece(p, f) ||
          isNeighbor(p, f))
        return;
      const Eigen::Vector3d nearest =
          nearestOnTriangle(point, corner, x.row(topology_->surface(f, 1)), x.row(topology_->surface(f, 2)));
      least = std::min(least, (point - nearest).norm());
    });
  }
  clearance_.set(x, least);
}

void SelfContact::collectTriangles(const Points& before, const Points& now) {
  setNormals(topology_->surface, before, &normals_before_);
  setNormals(topology_->surface, now, &normals_);
  triangles_.clear();
  triangle_boxes_.clear();
  for (int f = 0; f < topology_->surface.rows(); ++f) {
    Box box;
    for (int k = 0; k < 3; ++k) {
      const int v = topology_->surface(f, k);
      box.extend(before.row(v).transpose()).extend(now.row(v).transpose());
    }
    const auto grown = [&box](double margin) {
      return Box(box.min().array() - margin, box.max().array() + margin);
    };
    const Box wide = grown(std::max(options_.reach_m, options_.deepest_m));
    const bool is_near = isNear(piece_of_vertex_[static_cast<std::size_t>(topology_->surface(f, 0))], wide);
    if (!is_near && !parts_near_) continue;
    box = is_near ? wide : grown(options_.reach_m);
    triangles_.push_back(f);
    triangle_boxes_.push_back(box);
  }
}

void SelfContact::find(const std::vector<ContactPoint>& points, const Points& before, const Points& now,
                       std::vector<Contact>* contacts) {
  collectTriangles(before, now);
  if (triangles_.empty()) return;
  grid_.set(triangle_boxes_);
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Path path{p, positionOf(points[p].place, before, topology_->tets),
                    positionOf(points[p].place, now, topology_->tets)};
    Box box(path.start);
    box.extend(path.end);
    if (!parts_near_ && !isNear(piece_of_point_[p], box)) continue;
    Meetings meetings;
    grid_.visit(box, [&](int k) {
      const int triangle = triangles_[static_cast<std::size_t>(k)];
      const bool is_other_piece = isOfOtherPiece(p, triangle);
      if (is_other_piece || !isNeighbor(p, triangle))
        meet(path, triangle, is_other_piece, before, now, &meetings);
    });
    const Meeting meeting = choose(meetings);
    if (meeting.triangle >= 0) contacts->push_back(contactOf(path, meeting, before));
  }
}

bool SelfContact::isOfOtherPiece(std::size_t point, int triangle) const {
  const int vertex = topology_->surface(triangle, 0);
  return piece_of_vertex_[static_cast<std::size_t>(vertex)] != piece_of_point_[point];
}

/// Whether the point's surface faces the triangle. So a point at the rim of a face does not touch
/// the sides of a face that lies flush on it.
bool SelfContact::faces(std::size_t point, int triangle) const {
  constexpr double kFacing = -0.1;  // cosine of the angle between the normals
  for (const int own : triangles_of_point_[point])
    if (normals_.row(own).dot(normals_.row(triangle)) < kFacing) return true;
  return false;
}

void SelfContact::meet(const Path& path, int triangle, bool is_other_piece, const Points& before,
                       const Points& now, Meetings* best) const {
  const Eigen::Matrix3d start = cornersOf(topology_->surface, triangle, before),
                        end = cornersOf(topology_->surface, triangle, now);
  const double start_distance = normals_before_.row(triangle).dot(path.start - start.col(0)),
               end_distance = normals_.row(triangle).dot(path.end - end.col(0));
  const Eigen::Vector3d nearest = nearestOnTriangle(path.end, end.col(0), end.col(1), end.col(2));
  const double distance = (path.end - nearest).norm();
  if (is_other_piece && distance < best->surface_distance) {
    best->surface_distance = distance;
    best->is_inside = end_distance < 0.0;
  }
  if (!faces(path.point, triangle)) return;
  // A point that lies on the triangle is a little inside.
  if (start_distance >= -options_.largest_m && end_distance < std::min(0.0, start_distance)) {
    constexpr double kRim = -0.01;  // so that no point slips through between two triangles
    const double time = std::max(0.0, start_distance) / (std::max(0.0, start_distance) - end_distance);
    const Eigen::Vector3d weights =
        weightsOf((1.0 - time) * path.start + time * path.end, (1.0 - time) * start + time * end);
    if (weights.minCoeff() >= kRim && (best->crossed.triangle < 0 || time < best->time)) {
      best->crossed = {triangle, weights, end_distance};
      best->time = time;
    }
  }
  if (best->nearest.triangle >= 0 && distance >= std::abs(best->nearest.distance)) return;
  // Beside the triangle, its plane says little about the piece.
  const bool is_beside = distance > 0.01 * options_.reach_m && std::abs(end_distance) < 0.7 * distance;
  // Deep behind a triangle of its own piece, a point is on the far side of a thin part.
  const double deepest = is_other_piece ? options_.deepest_m : options_.largest_m;
  if (is_beside || end_distance > options_.reach_m || end_distance < -deepest) return;
  best->nearest = {triangle, weightsOf(nearest, end), end_distance};
}

/// The nearest triangle that faces the point is best, but only near the surface: deep inside, it may be that
/// of the far side, and behind it the point may be outside.
SelfContact::Meeting SelfContact::choose(const Meetings& meetings) const {
  const bool is_shallow = meetings.nearest.distance >= -options_.largest_m;
  const bool is_crossed = meetings.crossed.triangle >= 0;
  if (is_crossed &&
      (meetings.crossed.distance < -options_.largest_m || meetings.nearest.triangle < 0 || !is_shallow))
    return meetings.crossed;
  return is_shallow || meetings.is_inside ? meetings.nearest : Meeting();
}

Contact SelfContact::contactOf(const Path& path, const Meeting& meeting, const Points& before) const {
  Contact contact;
  contact.point = static_cast<int>(path.point);
  contact.obstacle = Contact::kBody;
  contact.normal = normals_.row(meeting.triangle);
  const int tet = tet_of_triangle_[static_cast<std::size_t>(meeting.triangle)];
  contact.other.tet = tet;
  for (int k = 0; k < 3; ++k) {
    for (int corner = 0; corner < 4; ++corner) {
      if (topology_->tets(tet, corner) == topology_->surface(meeting.triangle, k))
        contact.other.barycentric[corner] = meeting.weights[k];
    }
  }
  contact.anchor = path.start - positionOf(contact.other, before, topology_->tets);
  const double start_depth = std::max(0.0, -contact.normal.dot(contact.anchor));
  contact.position = -std::max(0.0, start_depth - options_.largest_m) * contact.normal;
  contact.depth = std::min(start_depth, options_.largest_m);
  contact.friction = options_.friction;
  return contact;
}

}  // namespace softbody
