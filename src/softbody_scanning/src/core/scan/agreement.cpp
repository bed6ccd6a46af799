#include "scan/agreement.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/images/rasterizer.h"
#include "softbody_common/statistics/median.h"

namespace softbody::scanning {
namespace {

constexpr double kThroughSigmas = 4.0;  // of inverse depth
constexpr double kUnusualSigmas = 5.0;  // of the frames' shares
constexpr double kSurelyRight = 0.03;   // of the pixels: edges of the object that are off by one pixel
constexpr int kEdge_px = 3;             // pixels at the object's outline say nothing: depth is smeared there

FrameAgreement agreementOf(const TriangleMesh& mesh, const KeyFrame& frame, double inverse_depth_std) {
  RasterImage image;
  rasterize(frame.camera, transformed(mesh.vertices, frame.T_camera_model), mesh.triangles, &image,
            Faces::kFront);
  FrameAgreement agreement{frame.stamp, 0, 0.0};
  int through = 0;
  const cv::Rect inner = image.region & cv::Rect(kEdge_px, kEdge_px, image.depth.cols - 2 * kEdge_px,
                                                 image.depth.rows - 2 * kEdge_px);
  for (int row = inner.y; row < inner.br().y; ++row) {
    for (int column = inner.x; column < inner.br().x; ++column) {
      const float expected = image.depth(row, column), measured = frame.depth(row, column);
      if (!(expected > 0.0f) || !(measured > 0.0f)) continue;
      if (image.depth(row - kEdge_px, column) == 0.0f || image.depth(row + kEdge_px, column) == 0.0f ||
          image.depth(row, column - kEdge_px) == 0.0f || image.depth(row, column + kEdge_px) == 0.0f)
        continue;
      ++agreement.pixels;
      if (1.0 / expected - 1.0 / measured > kThroughSigmas * inverse_depth_std) ++through;
    }
  }
  if (agreement.pixels > 0) agreement.through = static_cast<double>(through) / agreement.pixels;
  return agreement;
}

}  // namespace

std::vector<FrameAgreement> agreementWith(const TriangleMesh& mesh, const std::vector<KeyFrame>& frames,
                                          double inverse_depth_std) {
  std::vector<FrameAgreement> agreements(frames.size());
  tbb::parallel_for(std::size_t{0}, frames.size(),
                    [&](std::size_t i) { agreements[i] = agreementOf(mesh, frames[i], inverse_depth_std); });
  return agreements;
}

std::vector<bool> disagreeing(const std::vector<FrameAgreement>& frames) {
  if (frames.empty()) return {};
  std::vector<double> shares, deviations;
  for (const FrameAgreement& frame : frames) shares.push_back(frame.through);
  const double usual = medianOf(shares);
  for (const double share : shares) deviations.push_back(std::abs(share - usual));
  const double limit =
      std::max(kSurelyRight, usual + kUnusualSigmas * medianOf(deviations) / kMedianPerSigma);
  std::vector<bool> unusual;
  for (const double share : shares) unusual.push_back(share > limit);
  return unusual;
}

}  // namespace softbody::scanning
