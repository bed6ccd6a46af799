#include "registration/body_finder.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <tuple>

#include "registration/object_candidates.h"
#include "registration/pose_search.h"
#include "softbody_common/rigid_fit.h"

namespace softbody {
namespace {

constexpr int kCoarseColumns = 80, kFineColumns = 160, kFinestColumns = 320;
constexpr int kCoarseIcp = 10;
constexpr std::size_t kMostCandidates = 4, kKept = 4;
constexpr std::size_t kRefined = 4;  // of each place: a box has four poses that look alike
constexpr double kLeastArea = 0.25;  // of a mesh, that a coarser one keeps
constexpr double kOtherTurn = 0.35;  // [rad]
constexpr double kOtherPlace = 0.2;  // diameters

/// Every orientation is within some 35 degrees of one of these: views from the directions of a Fibonacci
/// sphere, with turns about the viewing axis.
std::vector<Eigen::Matrix3d> orientations() {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), z = Eigen::Vector3d::UnitZ();
  std::vector<Eigen::Matrix3d> result;
  constexpr int kViews = 24, kTurns = 6;
  const double golden_angle = M_PI * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < kViews; ++i) {
    const double height = 1.0 - 2.0 * (i + 0.5) / kViews;
    const Eigen::Matrix3d view =
        (Eigen::AngleAxisd(golden_angle * i, z) * Eigen::AngleAxisd(std::acos(height), x)).toRotationMatrix();
    for (int k = 0; k < kTurns; ++k) {
      result.push_back(Eigen::AngleAxisd(2.0 * M_PI * k / kTurns, z) * view.transpose());
    }
  }
  return result;
}

void sortByCost(std::vector<RegistrationResult>* poses) {
  std::stable_sort(poses->begin(), poses->end(),
                   [](const RegistrationResult& a, const RegistrationResult& b) { return a.cost < b.cost; });
}

/// Those first that most of the depth speaks for, then those of the least cost.
void sortBySupport(PoseSearch* search, std::vector<RegistrationResult>* poses) {
  std::vector<std::pair<double, RegistrationResult>> rated;
  for (const RegistrationResult& pose : *poses) rated.emplace_back(-search->support(pose.pose), pose);
  std::stable_sort(rated.begin(), rated.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first, a.second.cost) < std::tie(b.first, b.second.cost);
  });
  for (std::size_t i = 0; i < rated.size(); ++i) (*poses)[i] = rated[i].second;
}

/// One vertex for each cell, in the middle of those in it.
TriangleMesh inCells(const TriangleMesh& mesh, double cell_m) {
  std::map<std::tuple<int, int, int>, int> cells;
  std::vector<Eigen::Vector3d> sums;
  std::vector<int> counts, cluster(static_cast<std::size_t>(mesh.vertices.rows()));
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const Eigen::Vector3d p = mesh.vertices.row(v);
    const Eigen::Vector3i cell = (p / cell_m).array().floor().cast<int>();
    const auto [place, is_new] =
        cells.try_emplace({cell.x(), cell.y(), cell.z()}, static_cast<int>(sums.size()));
    if (is_new) sums.emplace_back(Eigen::Vector3d::Zero()), counts.push_back(0);
    cluster[v] = place->second;
    sums[place->second] += p;
    ++counts[place->second];
  }
  TriangleMesh result;
  result.vertices.resize(static_cast<Eigen::Index>(sums.size()), 3);
  for (std::size_t c = 0; c < sums.size(); ++c)
    result.vertices.row(static_cast<Eigen::Index>(c)) = sums[c] / counts[c];
  std::vector<Eigen::Vector3i> triangles;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Eigen::Vector3i t(cluster[mesh.triangles(f, 0)], cluster[mesh.triangles(f, 1)],
                            cluster[mesh.triangles(f, 2)]);
    if (t.x() != t.y() && t.y() != t.z() && t.z() != t.x()) triangles.push_back(t);
  }
  result.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    result.triangles.row(static_cast<Eigen::Index>(f)) = triangles[f];
  return result;
}

double area(const TriangleMesh& mesh) {
  double twice = 0.0;
  for (const auto& triangle : mesh.triangles.rowwise()) {
    const Eigen::Vector3d a = mesh.vertices.row(triangle[0]), b = mesh.vertices.row(triangle[1]),
                          c = mesh.vertices.row(triangle[2]);
    twice += (b - a).cross(c - a).norm();
  }
  return 0.5 * twice;
}

}  // namespace

TriangleMesh clustered(const TriangleMesh& mesh, double cell_m) {
  TriangleMesh coarse = inCells(mesh, cell_m);
  // Of a thread that lies in one row of cells no triangle remains.
  while (area(coarse) < kLeastArea * area(mesh)) coarse = inCells(mesh, cell_m *= 0.5);
  return coarse;
}

BodyFinder::BodyFinder(const TriangleMesh& rest_surface, const RegistrationConfig& config)
    : config_(config), mesh_(rest_surface) {
  const Eigen::Vector3d size = mesh_.vertices.colwise().maxCoeff() - mesh_.vertices.colwise().minCoeff();
  diameter_ = size.norm();
  coarse_ = clustered(mesh_, diameter_ / 25.0);
}

/// The body in every orientation, its middle a little behind the middle of what is seen.
std::vector<Eigen::Isometry3d> BodyFinder::startsAt(const Eigen::Vector3d& center) const {
  const Eigen::Vector3d middle =
      0.5 * (mesh_.vertices.colwise().maxCoeff() + mesh_.vertices.colwise().minCoeff());
  const Eigen::Vector3d behind = center + 0.1 * diameter_ * center.normalized();
  std::vector<Eigen::Isometry3d> starts;
  for (const Eigen::Matrix3d& R : orientations()) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = R;
    pose.translation() = behind - R * middle;
    starts.push_back(pose);
  }
  return starts;
}

/// The first ones that are unlike those before.
std::vector<RegistrationResult> BodyFinder::distinct(const std::vector<RegistrationResult>& poses,
                                                     std::size_t most) const {
  const Eigen::Vector3d center = mesh_.vertices.colwise().mean().transpose();
  const auto differs = [&](const RegistrationResult& a, const RegistrationResult& b) {
    const Eigen::Isometry3d between = a.pose.inverse() * b.pose;
    return Eigen::AngleAxisd(between.linear()).angle() > kOtherTurn ||
           (a.pose * center - b.pose * center).norm() > kOtherPlace * diameter_;
  };
  std::vector<RegistrationResult> kept;
  for (const RegistrationResult& pose : poses) {
    const bool is_new = std::all_of(kept.begin(), kept.end(),
                                    [&](const RegistrationResult& other) { return differs(pose, other); });
    if (is_new && kept.size() < most) kept.push_back(pose);
  }
  return kept;
}

/// The starts of each place to look at.
std::vector<std::vector<Eigen::Isometry3d>> BodyFinder::places(
    const RgbdFrame& frame, const ColorModel& colors, const std::vector<Eigen::Isometry3d>& guesses) const {
  std::vector<ObjectCandidate> candidates = findObjectCandidates(frame, colors, diameter_);
  candidates.resize(std::min(candidates.size(), kMostCandidates));
  std::vector<std::vector<Eigen::Isometry3d>> result;
  if (!guesses.empty()) result.push_back(guesses);
  for (const ObjectCandidate& candidate : candidates) result.push_back(startsAt(candidate.center));
  return result;
}

std::vector<RegistrationResult> BodyFinder::find(const RgbdFrame& frame, const ColorModel& colors,
                                                 const std::vector<Eigen::Isometry3d>& guesses) const {
  const RgbdFrame coarse = subsampled(frame, kCoarseColumns), fine = subsampled(frame, kFineColumns),
                  finest = subsampled(frame, kFinestColumns);
  PoseSearch search(coarse, coarse_, config_.distance_scale_m),
      finer(fine, coarse_, config_.distance_scale_m), last(finest, mesh_, config_.distance_scale_m);
  std::vector<RegistrationResult> found, firsts;
  for (const std::vector<Eigen::Isometry3d>& starts : places(fine, colors, guesses)) {
    std::vector<RegistrationResult> here;
    for (const Eigen::Isometry3d& start : starts) {
      const Eigen::Isometry3d pose = search.icp(start, kCoarseIcp);
      here.push_back({pose, search.cost(pose)});
    }
    sortByCost(&here);
    here = distinct(here, kRefined);
    for (RegistrationResult& pose : here) pose = finer.refine(pose.pose, 0.1, 0.02);
    sortBySupport(&finer, &here);
    firsts.push_back(here.front());
    found.insert(found.end(), here.begin(), here.end());
  }
  sortBySupport(&finer, &found);
  found = distinct(found, kKept);
  // Of every place the best is looked at closely: the coarse mesh suits some things better than the body.
  found.insert(found.end(), firsts.begin(), firsts.end());
  found = distinct(found, found.size());
  for (RegistrationResult& pose : found) pose = last.refine(pose.pose, 0.02, 0.003);
  sortBySupport(&last, &found);
  return distinct(found, found.size());
}

}  // namespace softbody
