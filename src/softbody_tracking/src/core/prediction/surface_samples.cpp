#include "prediction/surface_samples.h"

#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

/// Side of a block [px] that gives about the wanted number of blocks.
int blockSize(const RasterImage& image, int wanted) {
  const int covered = image.region.empty() ? 0 : cv::countNonZero(image.depth(image.region));
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(covered) / wanted))));
}

}  // namespace

SurfaceSamples sampleSurface(const PredictedSurface& surface, int wanted) {
  const RasterImage& image = surface.image();
  const cv::Rect& region = image.region;
  SurfaceSamples result;
  result.block_px = blockSize(image, wanted);
  const int size = result.block_px;
  result.grid.create((region.height + size - 1) / size, (region.width + size - 1) / size);
  result.grid.setTo(-1);
  result.samples.reserve(result.grid.total());
  for (int row = 0; row < result.grid.rows; ++row) {
    for (int column = 0; column < result.grid.cols; ++column) {
      const cv::Point center(std::min(region.x + column * size + size / 2, region.br().x - 1),
                             std::min(region.y + row * size + size / 2, region.br().y - 1));
      const int triangle = image.triangle(center);
      if (triangle < 0) continue;
      result.grid(row, column) = static_cast<int>(result.samples.size());
      const MaterialPoint place = surface.materialPoint(triangle, center);
      result.samples.push_back({center, place, surface.pieceOf(place),
                                surface.camera().unproject(center.x, center.y, image.depth(center)),
                                surface.normal(triangle)});
    }
  }
  return result;
}

int shownVertices(const SurfaceSamples& samples, const TetTopology& volume) {
  std::vector<bool> shown(static_cast<std::size_t>(volume.rest_vertices.rows()));
  for (const SurfaceSample& sample : samples.samples) {
    for (int k = 0; k < 4; ++k) shown[volume.tets(sample.place.tet, k)] = true;
  }
  return static_cast<int>(std::count(shown.begin(), shown.end(), true));
}

}  // namespace softbody
