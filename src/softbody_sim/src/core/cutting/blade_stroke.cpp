#include "core/cutting/blade_stroke.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/cutting/blade_outline.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

constexpr double kSameDirection = 0.85;  // cosine between normals of a slit and of a blade that is in it
constexpr double kLeastRest = 0.3;       // of an advance, that is cut when the blade turns back

/// Whether a patch lies within a distance of a point, and is turned there as a blade with this normal: one
/// that crosses the slit is in it too, at first.
bool lieNear(const std::vector<CutPatch>& patches, const Eigen::Vector3d& point,
             const Eigen::Vector3d& blade_normal, double tolerance) {
  double nearest = std::numeric_limits<double>::infinity();
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const CutPatch& patch : patches) {
    for (const auto& t : patch.triangles.rowwise()) {
      const Eigen::Vector3d a = patch.vertices.row(t[0]), b = patch.vertices.row(t[1]),
                            c = patch.vertices.row(t[2]);
      const double distance = (nearestOnTriangle(point, a, b, c) - point).norm();
      if (distance >= nearest) continue;
      nearest = distance;
      normal = (b - a).cross(c - a).stableNormalized();
    }
  }
  return nearest <= tolerance && std::abs(normal.dot(blade_normal)) >= kSameDirection;
}

std::vector<bool> containedIn(const RestSolid& solid, const Points& points) {
  std::vector<bool> inside;
  for (const auto& point : points.rowwise())
    inside.push_back(solid.contains(Eigen::Vector3d(point.transpose())));
  return inside;
}

bool any(const std::vector<bool>& flags) {
  return std::find(flags.begin(), flags.end(), true) != flags.end();
}

/// Of each point on a row, whether it or the way to a neighbour is in the solid: a corner of the body can lie
/// between two samples.
std::vector<bool> inMaterial(const Points& row, const RestSolid& solid) {
  std::vector<bool> in = containedIn(solid, row);
  for (Eigen::Index i = 0; i + 1 < row.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!solid.meets(row.row(i).transpose(), row.row(i + 1).transpose())) continue;
    in[k] = in[k + 1] = true;
  }
  return in;
}

/// Whether an outline passes through the solid, be it between two samples.
bool meets(const Points& outline, const RestSolid& solid) {
  Points closed(outline.rows() + 1, 3);
  closed << outline, outline.row(0);
  return any(inMaterial(closed, solid));
}

/// Points of the blade between its outline and its middle: a large blade's outline can enclose the body.
Points withinOutline(const Points& outline) {
  const Eigen::RowVector3d middle = outline.colwise().mean();
  Points within(2 * outline.rows(), 3);
  within.topRows(outline.rows()) = (2.0 * outline).rowwise() + middle;
  within.bottomRows(outline.rows()) = outline.rowwise() + 2.0 * middle;
  return within / 3.0;
}

/// The point moved on, unless that meets the solid.
Eigen::RowVector3d movedOn(const Eigen::RowVector3d& point, const Eigen::RowVector3d& way,
                           const RestSolid& solid) {
  const Eigen::Vector3d from = point, to = point + way;
  return solid.contains(from) || solid.meets(from, to) ? point : to.transpose();
}

/// An edge and one more point at either end, further out by the overhang.
Points withEnds(const Points& edge, double overhang, const RestSolid& solid) {
  const Eigen::Index last = edge.rows() - 1;
  Points row(edge.rows() + 2, 3);
  row.middleRows(1, edge.rows()) = edge;
  row.row(0) = movedOn(edge.row(0), overhang * (edge.row(0) - edge.row(1)).normalized(), solid);
  row.row(last + 2) =
      movedOn(edge.row(last), overhang * (edge.row(last) - edge.row(last - 1)).normalized(), solid);
  return row;
}

}  // namespace

BladeStroke::BladeStroke(const CuttingConfig& config, double spacing, double overhang)
    : config_(config), spacing_(spacing), overhang_(overhang) {}

void BladeStroke::forgetStrokes() {
  strokes_.clear();
  active_ = false;
}

std::optional<BladeCut> BladeStroke::follow(const Points& blade, const RestMap& map, const RestSolid& solid) {
  if (static_cast<Eigen::Index>(parts_.size()) != blade.rows()) {  // the first blade, or another one
    parts_ = partsOfSides(blade, spacing_);
    forgetStrokes();
    lift();
  }
  const BladeOutline outline(map.toRest(sampleOutline(blade, parts_)), parts_);
  const std::vector<bool> inside = containedIn(solid, outline.points());
  if (!active_ && any(inside)) active_ = resume(outline, inside) || enter(outline, inside, solid);
  std::optional<BladeCut> cut;
  if (active_) cut = advance(outline, solid);
  if (!any(inside) && !any(containedIn(solid, withinOutline(outline.points())))) {
    // A stroke ends here; one begins before the first corner is met, or that would stay uncut, unless the
    // blade was not seen there.
    if (active_ || clear_.rows() == 0 || !meets(outline.points(), solid)) clear_ = outline.points();
    outside_ = outline.points();
    active_ = cut.has_value();
    if (!active_ && !strokes_.empty() && strokes_.back().patches.empty()) strokes_.pop_back();
  }
  return cut;
}

bool BladeStroke::resume(const BladeOutline& outline, const std::vector<bool>& inside) {
  for (auto stroke = strokes_.rbegin(); stroke != strokes_.rend(); ++stroke) {
    int near = 0, all = 0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (!inside[i]) continue;
      ++all;
      const Eigen::Vector3d point = outline.points().row(static_cast<Eigen::Index>(i));
      if (lieNear(stroke->patches, point, outline.normal(), config_.slit_tolerance_m)) ++near;
    }
    if (3 * near < 2 * all) continue;
    if (stroke != strokes_.rbegin()) stroke->number = newNumber();
    std::rotate(std::prev(stroke.base()), stroke.base(), strokes_.end());
    return true;
  }
  return false;
}

bool BladeStroke::enter(const BladeOutline& outline, const std::vector<bool>& inside,
                        const RestSolid& solid) {
  if (outside_.rows() != outline.points().rows()) return false;
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (inside[i]) way += (outline.points().row(row) - outside_.row(row)).transpose();
  }
  way /= static_cast<double>(std::count(inside.begin(), inside.end(), true));
  way -= way.dot(outline.normal()) * outline.normal();
  if (way.norm() < config_.min_advance_m) return false;

  Stroke stroke;
  stroke.number = newNumber();
  stroke.edge = outline.leadingEdge(way.normalized());
  Points start = clear_(stroke.edge, Eigen::all);  // but not aside of where the blade goes in
  start += (outside_(stroke.edge, Eigen::all) - start) * outline.normal() * outline.normal().transpose();
  const Eigen::RowVector3d back = -std::max(config_.min_advance_m, overhang_) * way.normalized().transpose();
  for (Eigen::Index i = 0; i < start.rows(); ++i) start.row(i) = movedOn(start.row(i), back, solid);
  stroke.front = inSinglePrecision(withEnds(start, overhang_, solid));
  strokes_.push_back(std::move(stroke));
  startFromFront();
  return true;
}

void BladeStroke::startFromFront() {
  Stroke& stroke = strokes_.back();
  stroke.reach = stroke.front;
  stroke.reached = Eigen::VectorXd::Zero(stroke.front.rows());
  asked_.resize(0, 3);
}

std::optional<BladeCut> BladeStroke::advance(const BladeOutline& outline, const RestSolid& solid) {
  Stroke& stroke = strokes_.back();
  const Points row = withEnds(outline.points()(stroke.edge, Eigen::all), overhang_, solid);
  const Points normals = outline.outwardNormals(stroke.edge);
  double now = 0.0, most = 0.0;  // how far the blade is, and was, beyond the front where there is material
  Eigen::VectorXd ahead(row.rows());
  for (Eigen::Index i = 0; i < row.rows(); ++i) {
    const Eigen::Index k = std::clamp<Eigen::Index>(i - 1, 0, normals.rows() - 1);
    ahead[i] = normals.row(k).dot(row.row(i) - stroke.front.row(i));
    if (ahead[i] <= stroke.reached[i]) continue;
    stroke.reached[i] = ahead[i];
    stroke.reach.row(i) = row.row(i);
  }
  const std::vector<bool> began = inMaterial(stroke.front, solid), ends = inMaterial(stroke.reach, solid);
  for (Eigen::Index i = 0; i < row.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const bool cuts =
        began[k] || ends[k] || solid.meets(stroke.front.row(i).transpose(), stroke.reach.row(i).transpose());
    if (!cuts) continue;
    now = std::max(now, ahead[i]);
    most = std::max(most, stroke.reached[i]);
  }
  const bool is_through = any(began) && !any(ends) && most > 0.0;
  const bool turned_back =
      most >= kLeastRest * config_.min_advance_m && now <= most - kLeastRest * config_.min_advance_m;
  if (most < config_.min_advance_m && !is_through && !turned_back) return std::nullopt;

  Points next = stroke.reach;
  for (Eigen::Index i = 0; is_through && i < next.rows(); ++i) {
    const Eigen::Index k = std::clamp<Eigen::Index>(i - 1, 0, normals.rows() - 1);
    next.row(i) = movedOn(next.row(i), overhang_ * normals.row(k), solid);
  }
  next = inSinglePrecision(next);
  if (asked_.rows() == next.rows() && asked_ == next) return std::nullopt;
  asked_ = next;
  asked_patch_ = ruledPatch(stroke.front, next);
  return BladeCut{stroke.number, asked_patch_};
}

void BladeStroke::accept() {
  Stroke& stroke = strokes_.back();
  stroke.front = asked_;
  stroke.patches.push_back(asked_patch_);
  startFromFront();
}

}  // namespace softbody
