#include "softbody_scanning/fusion/volume.h"

#include <tbb/parallel_for.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "fusion/depth_range.h"

namespace softbody::scanning {
namespace {

// So near it is the surface, so far in front it is empty: noise does not turn one into the other.
constexpr float kSameSigmas = 1.0f, kEmptySigmas = 6.0f;
constexpr float kSeenOfNoise = 1.4142f;  // exp(-x^2 / 2) of normal noise is 1 / sqrt(2) on the mean
constexpr int kBlock = 8;                // grid points along a block's side

/// A view with what its evidence is computed from.
struct FusedView {
  const DepthView* view;
  DepthRange range;
  Eigen::Matrix3f rotation;
  Eigen::Vector3f translation;
};

/// Sums while the views are added.
struct Sums {
  float weighted_distance = 0.0f, weight = 0.0f, seen = 0.0f;
  int behind = 0, measured = 0, empty = 0;
};

class Fuser {
 public:
  Fuser(const FusionBox& box, double inverse_depth_std)
      : reach_(static_cast<float>(box.reach_m)),
        variance_(static_cast<float>(inverse_depth_std * inverse_depth_std)) {}

  void addEmpty(float z, Sums* sums) const {
    const float weight = inverseVariance(z);
    sums->weight += weight;
    sums->weighted_distance += weight * reach_;
    ++sums->empty;
  }

  void add(const FusedView& fused, const Eigen::Vector3f& place, Sums* sums) const {
    const DepthView& view = *fused.view;
    const Eigen::Vector3f p = fused.rotation * place + fused.translation;
    if (!(p.z() > 0.05f)) return;
    const int u = static_cast<int>(std::lround(view.camera.fx * p.x() / p.z() + view.camera.cx));
    const int v = static_cast<int>(std::lround(view.camera.fy * p.y() / p.z() + view.camera.cy));
    if (u < 0 || v < 0 || u >= view.depth.cols || v >= view.depth.rows) return;
    const float z = view.depth(v, u);
    if (!(z > 0.0f)) return;
    if (p.z() < view.nearest(v, u) - reach_) return addEmpty(p.z(), sums);
    const cv::Vec3f& n = view.plane(v, u);
    const Eigen::Map<const Eigen::Vector3f> plane(n.val);
    if (plane.isZero()) {  // an edge: only what lies behind it is certain
      if (p.z() > z + reach_) ++sums->behind;
      return;
    }
    const float length = plane.norm();
    const float distance = (1.0f - plane.dot(p)) / length;
    if (distance < -reach_) {
      ++sums->behind;
      return;
    }
    const Eigen::Vector3f ray((u - view.camera.cx) / view.camera.fx, (v - view.camera.cy) / view.camera.fy,
                              1.0f);
    const float cosine = 1.0f / (length * z * ray.norm());
    const float weight = cosine * inverseVariance(z);
    sums->weight += weight;
    const float sigmas = distance / (cosine * z * z * std::sqrt(variance_));
    sums->seen += weight * std::exp(-0.5f * sigmas * sigmas);
    if (std::abs(sigmas) < kSameSigmas) ++sums->measured;
    if (distance > reach_ && sigmas > kEmptySigmas) ++sums->empty;
    sums->weighted_distance += weight * std::min(distance, reach_);
  }

 private:
  float inverseVariance(float z) const { return 1.0f / (variance_ * z * z * z * z); }

  float reach_, variance_;
};

PlaceEvidence evidenceOf(const Sums& sums) {
  const float distance = sums.weight > 0.0f ? sums.weighted_distance / sums.weight : 0.0f;
  return {distance, sums.weight, sums.seen, sums.behind, sums.measured, sums.empty};
}

}  // namespace

Volume::Volume(const FusionBox& box, const std::vector<DepthView>& views, double inverse_depth_std)
    : box_(box),
      size_((box.box.sizes() / box.voxel_m).array().floor().cast<int>() + 1),
      places_(static_cast<std::size_t>(size_.x()) * size_.y() * size_.z()) {
  std::vector<FusedView> fused;
  for (const DepthView& view : views)
    fused.push_back({&view, DepthRange(view), view.T_camera_model.linear().cast<float>(),
                     view.T_camera_model.translation().cast<float>()});
  const Fuser fuser(box, inverse_depth_std);
  const Eigen::Vector3i blocks = (size_.array() + kBlock - 1) / kBlock;
  const double half = 0.5 * (kBlock - 1) * box.voxel_m, radius = std::sqrt(3.0) * half;
  tbb::parallel_for(0, blocks.prod(), [&](int block) {
    const Eigen::Vector3i first(kBlock * (block % blocks.x()), kBlock * (block / blocks.x() % blocks.y()),
                                kBlock * (block / (blocks.x() * blocks.y())));
    const Eigen::Vector3d center = place(first) + Eigen::Vector3d::Constant(half);
    Sums common;
    std::vector<const FusedView*> mixed;
    for (const FusedView& view : fused) {
      const Eigen::Vector3d in_camera = view.view->T_camera_model * center;
      const BlockSight sight = view.range.sightOf(in_camera, radius, box.reach_m);
      if (sight == BlockSight::kEmpty) fuser.addEmpty(static_cast<float>(in_camera.z()), &common);
      if (sight == BlockSight::kHidden) ++common.behind;
      if (sight == BlockSight::kMixed) mixed.push_back(&view);
    }
    const Eigen::Vector3i last = (first.array() + kBlock).min(size_.array());
    for (int z = first.z(); z < last.z(); ++z)
      for (int y = first.y(); y < last.y(); ++y)
        for (int x = first.x(); x < last.x(); ++x) {
          Sums sums = common;
          const Eigen::Vector3f here = place({x, y, z}).cast<float>();
          for (const FusedView* view : mixed) fuser.add(*view, here, &sums);
          places_[offset({x, y, z})] = evidenceOf(sums);
        }
  });
}

float Volume::distance(const Eigen::Vector3i& index) const {
  const PlaceEvidence& evidence = at(index);
  if (evidence.weight > 0.0f) return evidence.distance;
  return static_cast<float>(evidence.behind > 0 ? -box_.reach_m : box_.reach_m);
}

void Volume::forgetBelow(const Eigen::Hyperplane<double, 3>& table, double clear_m) {
  for (int z = 0; z < size_.z(); ++z)
    for (int y = 0; y < size_.y(); ++y)
      for (int x = 0; x < size_.x(); ++x) {
        const double height = table.signedDistance(place({x, y, z}));
        if (height > 2.0 * clear_m) continue;
        PlaceEvidence& evidence = places_[offset({x, y, z})];
        // It comes back gradually, so that the surface has no step there.
        const float kept = static_cast<float>(std::clamp(height / clear_m - 1.0, 0.0, 1.0));
        evidence.weight *= kept;
        evidence.seen *= kept;
        if (kept == 0.0f) evidence = {0.0f, 0.0f, 0.0f, 1};
      }
}

void Volume::add(const Volume& other) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    PlaceEvidence& mine = places_[i];
    const PlaceEvidence& more = other.places_[i];
    const float weight = mine.weight + more.weight;
    if (weight > 0.0f) mine.distance = (mine.weight * mine.distance + more.weight * more.distance) / weight;
    mine.weight = weight;
    mine.seen += more.seen;
    mine.behind += more.behind;
    mine.measured += more.measured;
    mine.empty += more.empty;
  }
}

float Volume::seenAround(const Eigen::Vector3d& place, double depth_std_m) const {
  const float one_view = static_cast<float>(1.0 / (depth_std_m * depth_std_m));
  const Eigen::Vector3i low = ((place - box_.box.min()) / box_.voxel_m).array().floor().cast<int>();
  float most = 0.0f;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3i index = low + Eigen::Vector3i(corner & 1, corner >> 1 & 1, corner >> 2);
    const PlaceEvidence& evidence = at(index.cwiseMax(0).cwiseMin(size_ - Eigen::Vector3i::Ones()));
    if (evidence.weight > 0.0f)
      most =
          std::max(most, std::min(evidence.seen / one_view, kSeenOfNoise * evidence.seen / evidence.weight));
  }
  return std::min(1.0f, most);
}

}  // namespace softbody::scanning
