#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_scanning/key_frames/key_frame.h"
#include "texture/edge_neighbors.h"

namespace softbody::scanning {

/// Connected triangles of one frame, or one triangle that no frame saw. Texels of the picture are pixels of
/// the frame, moved and perhaps made smaller.
struct Chart {
  int frame = -1;              ///< -1: not seen
  std::vector<int> triangles;  ///< ascending
  cv::Rect source;             ///< pixels of the frame that hold the triangles and a border
  double scale = 1.0;          ///< texels per pixel
  cv::Rect place;              ///< texels of the picture
};

/// Where the charts are in the picture.
struct Layout {
  std::vector<Chart> charts;
  std::vector<int> chart_of;  ///< #F
  cv::Size size;              ///< of the picture [texels]
};

constexpr int kBorder = 3;      // texels around a chart
constexpr int kUnseenSide = 4;  // of a chart that was not seen: corners at two texels, and one around

/// The charts in one picture, in shelves (rows as high as their first chart). @param label of each triangle:
/// its frame, or -1.
Layout layOutCharts(const TriangleMesh& mesh, const EdgeNeighbors& neighbors, const std::vector<int>& label,
                    const std::vector<KeyFrame>& frames, int largest_side_px);

/// Place of a vertex in a frame [px].
Eigen::Vector2d pixelOf(const TriangleMesh& mesh, int vertex, const KeyFrame& frame);

/// Place of a pixel of the chart's frame in the picture [texels]; centres of texels are at integers.
inline Eigen::Vector2d texelOf(const Chart& chart, const Eigen::Vector2d& pixel) {
  return chart.scale * (pixel - Eigen::Vector2d(chart.source.x, chart.source.y)) +
         Eigen::Vector2d(chart.place.x, chart.place.y);
}

}  // namespace softbody::scanning
