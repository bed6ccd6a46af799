#include "softbody_tracking/known/known_surface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "agreement/pose_cost.h"
#include "softbody_common/images/rasterizer.h"

namespace softbody {
namespace {

/// Nearest and farthest rendered depth around each pixel of a region [m]; infinite and 0: nothing is
/// rendered.
struct DepthRange {
  cv::Mat1f nearest, farthest;
};

/// @param around_px how far the rendered surface may be shifted in the image.
DepthRange rangeAround(const cv::Mat1f& rendered, int around_px) {
  const cv::Mat kernel = cv::Mat::ones(2 * around_px + 1, 2 * around_px + 1, CV_8U);
  DepthRange range;
  cv::Mat1f behind = rendered.clone();
  behind.setTo(std::numeric_limits<float>::infinity(), rendered <= 0.0f);
  cv::erode(behind, range.nearest, kernel);
  cv::dilate(rendered, range.farthest, kernel);
  return range;
}

/// Shifts by the rounding of pixels and by one standard deviation: beside the outline a pixel shows the known
/// surface as often as not.
int shiftInImage(const RgbdFrame& frame, const KnownSurface& known) {
  const double nearest = std::max(1e-3, known.surface.vertices.col(2).minCoeff());
  return 1 + static_cast<int>(known.deviation_m * frame.camera.fx / nearest);
}

/// Writes the rendered depth of pixels that show a surface; beside its outline the measured one.
void mark(const cv::Mat1f& rendered, const cv::Rect& region, double deviation_m, int around_px,
          RgbdFrame* frame) {
  const DepthRange range = rangeAround(rendered(region), around_px);
  for (int v = 0; v < region.height; ++v) {
    const float *depth = frame->depth[v + region.y] + region.x, *behind = rendered[v + region.y] + region.x;
    float* known = frame->known[v + region.y] + region.x;
    for (int u = 0; u < region.width; ++u) {
      if (!(range.farthest(v, u) > 0.0f)) continue;
      const float measured = depth[u];
      const float margin =
          static_cast<float>(kDoubt * std::hypot(depthSigma(range.nearest(v, u)), deviation_m));
      const bool shown = measured > 0.0f ? measured >= range.nearest(v, u) - margin &&
                                               measured <= range.farthest(v, u) + margin
                                         : behind[u] > 0.0f;
      if (!shown) continue;
      const float z = behind[u] > 0.0f ? behind[u] : measured;
      if (known[u] == 0.0f || z < known[u]) known[u] = z;
    }
  }
}

}  // namespace

RgbdFrame withKnownSurfaces(RgbdFrame frame, const std::vector<KnownSurface>& surfaces) {
  frame.known = {};
  RasterImage image;
  for (const KnownSurface& known : surfaces) {
    rasterize(frame.camera, known.surface.vertices, known.surface.triangles, &image);
    const int around_px = shiftInImage(frame, known);
    const cv::Rect grown(image.region.tl() - cv::Point(around_px, around_px),
                         image.region.br() + cv::Point(around_px, around_px));
    const cv::Rect region = grown & cv::Rect({}, frame.depth.size());
    if (image.region.empty() || region.empty()) continue;
    if (frame.known.empty()) frame.known = cv::Mat1f(frame.depth.size(), 0.0f);
    mark(image.depth, region, known.deviation_m, around_px, &frame);
  }
  return frame;
}

RgbdFrame withoutKnownDepth(const RgbdFrame& frame) {
  if (frame.known.empty()) return frame;
  RgbdFrame result = frame;
  result.depth = frame.depth.clone();
  result.depth.setTo(0.0f, frame.known > 0.0f);
  return result;
}

}  // namespace softbody
