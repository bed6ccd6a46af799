#include "depth_associations.h"

#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

constexpr double kMostGrazing = 0.2;  // cosine between normal and ray below which depth says little

/// The depth differences of one block of pixels.
struct BlockDepth {
  int measured = 0, agreeing = 0, nearer = 0, farther = 0, foreign = 0;
  double difference = 0.0;  ///< mean of the agreeing pixels: measured minus predicted [m]
};

BlockDepth measureBlock(const RgbdFrame& frame, const RasterImage& image, const cv::Mat1b& body_colors,
                        const cv::Rect& block, double max_distance) {
  BlockDepth result;
  double sum = 0.0;
  for (int v = block.y; v < block.y + block.height; ++v) {
    for (int u = block.x; u < block.x + block.width; ++u) {
      const float z = frame.depth(v, u);
      if (image.triangle(v, u) < 0 || z <= 0.0f) continue;
      ++result.measured;
      const double difference = z - image.depth(v, u);
      if (difference < -max_distance) {
        ++result.nearer;
      } else if (difference > max_distance) {
        ++result.farther;
      } else if (body_colors(v, u) == 0) {
        ++result.foreign;
      } else {
        ++result.agreeing;
        sum += difference;
      }
    }
  }
  if (result.agreeing > 0) result.difference = sum / result.agreeing;
  return result;
}

/// Block size that yields about the wanted number of blocks on the covered pixels.
int blockSize(const RasterImage& image, int wanted) {
  const int covered = image.region.empty() ? 0 : cv::countNonZero(image.depth(image.region));
  return std::max(1, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(covered) / wanted))));
}

}  // namespace

DepthAssociations associateDepth(const RgbdFrame& frame, const PredictedSurface& surface,
                                 const cv::Mat1b& body_colors, double volume_edge_m,
                                 const DepthConfig& config) {
  const RasterImage& image = surface.image();
  const int size = blockSize(image, config.max_targets);
  DepthAssociations result;
  for (int v = image.region.y; v < image.region.br().y; v += size) {
    for (int u = image.region.x; u < image.region.br().x; u += size) {
      const cv::Rect block = cv::Rect(u, v, size, size) & image.region;
      const cv::Point center(block.x + block.width / 2, block.y + block.height / 2);
      if (image.triangle(center) < 0) continue;
      const BlockDepth depth = measureBlock(frame, image, body_colors, block, config.max_distance_m);
      if (depth.measured == 0) continue;
      ++result.visible_blocks;
      if (2 * (depth.nearer + depth.foreign) > depth.measured) ++result.occluded_blocks;
      if (2 * depth.farther > depth.measured) ++result.absent_blocks;
      if (2 * depth.agreeing <= depth.measured) continue;

      const Eigen::Vector3d predicted = frame.camera.unproject(center.x, center.y, image.depth(center));
      const Eigen::Vector3d normal = surface.normal(center);
      if (-normal.dot(predicted.normalized()) < kMostGrazing) continue;
      Association association;
      association.kind = TargetKind::kDepth;
      association.place = surface.materialPoint(center);
      association.predicted = predicted;
      association.measured =
          frame.camera.unproject(center.x, center.y, image.depth(center) + depth.difference);
      association.normal = normal;
      const double block_width_m = size * predicted.z() / frame.camera.fx;
      association.weight = config.weight * std::pow(block_width_m / volume_edge_m, 2);
      result.associations.push_back(association);
    }
  }
  return result;
}

}  // namespace softbody
