#include "picture/color_patches.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "agreement/pose_cost.h"
#include "agreement/subsampled_frame.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/images/rasterizer.h"

namespace softbody {
namespace {

// From this value on a pixel may be saturated: then its colour is unknown.
constexpr uchar kSaturated = 250;
// Least length of the mean normal in a patch: at a crease the light of two sides mixes.
constexpr double kFlat = 0.97;
// Pixels from the outline in which colours of body and background mix: colour and depth are as far apart.
constexpr int kMixed = 2;

/// Sums over the pixels of one patch.
struct PatchSum {
  int pixels = 0;
  Eigen::Vector3d pictured = Eigen::Vector3d::Zero(), seen = Eigen::Vector3d::Zero(),
                  normal = Eigen::Vector3d::Zero();
};

Eigen::Vector3d logColor(const Eigen::Vector3d& sum, int pixels) {
  return (sum / pixels).cwiseMax(1.0).array().log();
}

Eigen::Vector3d normalOf(const Points& vertices, const Triangles& triangles, int f) {
  const Eigen::Vector3d a = vertices.row(triangles(f, 0)), b = vertices.row(triangles(f, 1)),
                        c = vertices.row(triangles(f, 2));
  return (b - a).cross(c - a).normalized();
}

/// Whether a pixel shows nothing but the mesh.
bool isInside(const RasterImage& image, int v, int u) {
  const cv::Mat1i& shown = image.triangle;
  if (u < kMixed || v < kMixed || u + kMixed >= shown.cols || v + kMixed >= shown.rows) return false;
  return shown(v, u) >= 0 && shown(v, u - kMixed) >= 0 && shown(v, u + kMixed) >= 0 &&
         shown(v - kMixed, u) >= 0 && shown(v + kMixed, u) >= 0;
}

}  // namespace

RgbdFrame colorFrame(const RgbdFrame& frame) {
  RgbdFrame smooth = frame;
  const int step = std::max(1, frame.depth.cols / kLargeColumns);
  const int side = step | 1;  // odd: the mean stays at its pixel
  cv::blur(frame.color, smooth.color, cv::Size(side, side));
  return subsampled(smooth, kLargeColumns);
}

std::vector<ColorPatch> colorPatches(const RgbdFrame& frame, const TriangleMesh& mesh,
                                     const BakedPicture& picture, const Eigen::Isometry3d& pose) {
  const Points vertices = transformed(mesh.vertices, pose);
  RasterImage image;
  rasterize(frame.camera, vertices, mesh.triangles, &image);
  const int columns = image.depth.cols / kPatchPixels + 1, rows = image.depth.rows / kPatchPixels + 1;
  std::vector<PatchSum> sums(static_cast<std::size_t>(columns * rows));
  for (int v = image.region.y; v < image.region.br().y; ++v) {
    for (int u = image.region.x; u < image.region.br().x; ++u) {
      const double z = image.depth(v, u), difference = std::abs(frame.depth(v, u) - z);
      if (!isInside(image, v, u) || !(difference < distanceScaleAt(z))) continue;
      const cv::Vec3b& seen = frame.color(v, u);
      if (std::max({seen[0], seen[1], seen[2]}) >= kSaturated) continue;
      const int f = image.triangle(v, u);
      const Eigen::Vector3d weights = rayWeights(frame.camera, vertices, mesh.triangles, f, u, v);
      const cv::Vec3f* color = picture.at(f, weights[1], weights[2]);
      if (color == nullptr) continue;
      PatchSum& sum = sums[static_cast<std::size_t>(v / kPatchPixels * columns + u / kPatchPixels)];
      ++sum.pixels;
      sum.pictured += Eigen::Vector3d((*color)[0], (*color)[1], (*color)[2]);
      sum.seen += Eigen::Vector3d(seen[0], seen[1], seen[2]);
      sum.normal += normalOf(vertices, mesh.triangles, f);
    }
  }
  std::vector<ColorPatch> patches;
  for (int k = 0; k < columns * rows; ++k) {
    const PatchSum& sum = sums[static_cast<std::size_t>(k)];
    if (2 * sum.pixels < kPatchPixels * kPatchPixels || sum.normal.norm() < kFlat * sum.pixels) continue;
    patches.push_back({{k % columns, k / columns},
                       logColor(sum.pictured, sum.pixels),
                       logColor(sum.seen, sum.pixels),
                       sum.normal / sum.pixels});
  }
  return patches;
}

}  // namespace softbody
