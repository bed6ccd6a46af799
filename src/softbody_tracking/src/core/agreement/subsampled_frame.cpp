#include "agreement/subsampled_frame.h"

#include <algorithm>

namespace softbody {

RgbdFrame subsampled(const RgbdFrame& frame, int columns) {
  const int k = std::max(1, frame.camera.width / columns);
  if (k == 1) return frame;
  RgbdFrame small;
  small.stamp = frame.stamp;
  const int offset = k / 2;
  small.camera = {frame.camera.width / k, frame.camera.height / k,        frame.camera.fx / k,
                  frame.camera.fy / k,    (frame.camera.cx - offset) / k, (frame.camera.cy - offset) / k};
  small.color.create(small.camera.height, small.camera.width);
  small.depth.create(small.camera.height, small.camera.width);
  for (int v = 0; v < small.depth.rows; ++v) {
    for (int u = 0; u < small.depth.cols; ++u) {
      small.color(v, u) = frame.color(v * k + offset, u * k + offset);
      small.depth(v, u) = frame.depth(v * k + offset, u * k + offset);
    }
  }
  return small;
}

}  // namespace softbody
