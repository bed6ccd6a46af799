#include "cutting/blade/blade_stroke.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <set>

#include "cutting/blade/blade_outline.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

constexpr double kSameDirection = 0.85;  // cosine of the angle between a slit and a blade in it
constexpr double kLeastRest = 0.3;       // of an advance: smallest cut when the blade turns back
constexpr double kTouch = 0.3;           // of an advance: a blade less deep than this only touches the body

/// Whether a patch is near a point and nearly parallel to the blade there. A blade that crosses a slit is
/// near it too, but not parallel.
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

/// Per point of a polyline, whether it or a segment to a neighbour meets the solid: a corner of the body can
/// lie between two samples.
std::vector<bool> inMaterial(const Points& row, const RestSolid& solid) {
  std::vector<bool> in = containedIn(solid, row);
  for (Eigen::Index i = 0; i + 1 < row.rows(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!solid.meets(row.row(i).transpose(), row.row(i + 1).transpose())) continue;
    in[k] = in[k + 1] = true;
  }
  return in;
}

/// Parameters of an outline inside a solid: samples, and between two samples the middle of the part inside.
/// The integer part is the number of a sample, the fraction is the position on the segment to the next one.
std::vector<double> placesIn(const Points& outline, const RestSolid& solid) {
  std::vector<double> places;
  for (Eigen::Index i = 0; i < outline.rows(); ++i) {
    const Eigen::Vector3d from = outline.row(i), to = outline.row((i + 1) % outline.rows());
    if (solid.contains(from)) {
      places.push_back(static_cast<double>(i));
      continue;
    }
    const std::vector<PatchHit> hits = solid.crossings(from, to);
    if (hits.size() >= 2) places.push_back(static_cast<double>(i) + 0.5 * (hits[0].t + hits[1].t));
  }
  return places;
}

Eigen::Vector3d pointAt(const Points& outline, double place) {
  const auto i = static_cast<Eigen::Index>(place);
  const double share = place - static_cast<double>(i);
  return (1.0 - share) * outline.row(i) + share * outline.row((i + 1) % outline.rows());
}

/// Points between outline and centre of the blade: the outline of a large blade can enclose the body.
Points withinOutline(const Points& outline) {
  const Eigen::RowVector3d middle = outline.colwise().mean();
  Points within(2 * outline.rows(), 3);
  within.topRows(outline.rows()) = (2.0 * outline).rowwise() + middle;
  within.bottomRows(outline.rows()) = outline.rowwise() + 2.0 * middle;
  return within / 3.0;
}

/// The point moved by `way`, or the point itself if it or the segment meets the solid.
Eigen::RowVector3d movedOn(const Eigen::RowVector3d& point, const Eigen::RowVector3d& way,
                           const RestSolid& solid) {
  const Eigen::Vector3d from = point, to = point + way;
  return solid.contains(from) || solid.meets(from, to) ? point : to.transpose();
}

/// An edge extended by one point at either end, by the overhang.
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

struct BladeStroke::Contact {
  BladeOutline outline;
  Points inner;                ///< the outline without the touching margin
  std::vector<double> places;  ///< parameters of `inner` in the body, see placesIn
};

BladeStroke::BladeStroke(const CuttingConfig& config, double spacing, double overhang)
    : config_(config), spacing_(spacing), overhang_(overhang) {}

void BladeStroke::forgetStrokes() {
  strokes_.clear();
  active_ = false;
}

std::optional<BladeCut> BladeStroke::follow(const Points& blade, const RestMap& map, const RestSolid& solid) {
  if (static_cast<Eigen::Index>(parts_.size()) != blade.rows()) {  // the first blade, or another polygon
    parts_ = partsOfSides(blade, spacing_);
    forgetStrokes();
    lift();
  }
  Contact now{BladeOutline(map.toRest(sampleOutline(blade, parts_)), parts_), {}, {}};
  now.inner = now.outline.setBack(kTouch * config_.min_advance_m);
  now.places = placesIn(now.inner, solid);
  if (!active_ && !now.places.empty()) active_ = resume(now) || enter(now, solid);
  std::optional<BladeCut> cut;
  if (active_) cut = advance(now.outline, solid);
  if (now.places.empty() && !any(containedIn(solid, withinOutline(now.outline.points())))) {
    clear_ = now.inner;
    active_ = cut.has_value();
    if (!active_ && !strokes_.empty() && strokes_.back().patches.empty()) strokes_.pop_back();
  }
  return cut;
}

bool BladeStroke::resume(const Contact& now) {
  for (auto stroke = strokes_.rbegin(); stroke != strokes_.rend(); ++stroke) {
    const auto near = std::count_if(now.places.begin(), now.places.end(), [&](double place) {
      return lieNear(stroke->patches, pointAt(now.inner, place), now.outline.normal(),
                     config_.slit_tolerance_m);
    });
    if (3 * static_cast<std::size_t>(near) < 2 * now.places.size()) continue;
    if (stroke != strokes_.rbegin()) stroke->number = newNumber();
    std::rotate(std::prev(stroke.base()), stroke.base(), strokes_.end());
    return true;
  }
  return false;
}

/// The motion of the blade since it was last outside of the body, along the normals of its sides in the body.
/// Motion along a side does not count. Its length is the largest advance of a side, or of the motion along
/// the combined direction if that is longer: a tip advances further than its sides.
Eigen::Vector3d BladeStroke::wayIn(const Contact& now) const {
  Eigen::Vector3d moved = Eigen::Vector3d::Zero();
  std::set<int> sides;
  for (const double place : now.places) {
    moved += pointAt(now.inner, place) - pointAt(clear_, place);
    sides.insert(now.outline.sideFrom(static_cast<int>(std::floor(place))));
    sides.insert(now.outline.sideTo(static_cast<int>(std::ceil(place))));
  }
  moved /= static_cast<double>(now.places.size());
  Eigen::Vector3d way = Eigen::Vector3d::Zero();
  double furthest = 0.0;
  for (const int side : sides) {
    const double advance = std::max(0.0, moved.dot(now.outline.sideNormal(side)));
    furthest = std::max(furthest, advance);
    way += advance * now.outline.sideNormal(side);
  }
  way.stableNormalize();
  return std::max(furthest, moved.dot(way)) * way;
}

bool BladeStroke::enter(const Contact& now, const RestSolid& solid) {
  if (clear_.rows() != now.inner.rows()) return false;
  const Eigen::Vector3d way = wayIn(now);
  if (way.norm() < config_.min_advance_m) return false;

  Stroke stroke;
  stroke.number = newNumber();
  stroke.edge = now.outline.leadingEdge(way.normalized());
  Points start = now.outline.points()(stroke.edge, Eigen::all);
  const Eigen::RowVector3d back = -way.normalized().transpose();
  const double margin = std::max(config_.min_advance_m, overhang_);
  for (Eigen::Index i = 0; i < start.rows(); ++i) {
    // Straight back to the position outside, without earlier sideways motion.
    start.row(i) += std::max(0.0, (clear_.row(stroke.edge[i]) - start.row(i)).dot(back)) * back;
    start.row(i) = movedOn(start.row(i), margin * back, solid);
  }
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
  double now = 0.0, most = 0.0;  // advance now, and largest advance, where there is material
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
