#include "texture/charts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace softbody::scanning {
namespace {

constexpr double kSmaller = 0.85;  // texels, at each try to make the picture fit

/// The connected triangles of one label from `seed` on.
std::vector<int> grow(int seed, const EdgeNeighbors& neighbors, const std::vector<int>& label,
                      std::vector<int>* chart_of, int chart) {
  std::vector<int> found{seed};
  (*chart_of)[static_cast<std::size_t>(seed)] = chart;
  for (std::size_t i = 0; i < found.size(); ++i) {
    for (const int next : neighbors[static_cast<std::size_t>(found[i])]) {
      if (next < 0 || (*chart_of)[static_cast<std::size_t>(next)] >= 0 ||
          label[static_cast<std::size_t>(next)] != label[static_cast<std::size_t>(seed)])
        continue;
      (*chart_of)[static_cast<std::size_t>(next)] = chart;
      found.push_back(next);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Pixels of the frame around the chart's triangles. It may reach beyond the image.
cv::Rect sourceOf(const TriangleMesh& mesh, const Chart& chart, const KeyFrame& frame) {
  Eigen::AlignedBox2d box;
  for (const int t : chart.triangles) {
    for (int k = 0; k < 3; ++k) box.extend(pixelOf(mesh, mesh.triangles(t, k), frame));
  }
  const cv::Point low(static_cast<int>(std::floor(box.min().x())) - kBorder,
                      static_cast<int>(std::floor(box.min().y())) - kBorder);
  const cv::Point high(static_cast<int>(std::ceil(box.max().x())) + kBorder,
                       static_cast<int>(std::ceil(box.max().y())) + kBorder);
  return {low.x, low.y, high.x - low.x + 1, high.y - low.y + 1};
}

void scaleTo(double scale, const TriangleMesh& mesh, const std::vector<KeyFrame>& frames, Chart* chart) {
  chart->place = {0, 0, kUnseenSide, kUnseenSide};
  if (chart->frame < 0) return;
  chart->scale = scale;
  chart->source = sourceOf(mesh, *chart, frames[static_cast<std::size_t>(chart->frame)]);
  // The border has its width in texels.
  const int wider = static_cast<int>(std::ceil(kBorder / scale)) - kBorder;
  chart->source -= cv::Point(wider, wider);
  chart->source += cv::Size(2 * wider, 2 * wider);
  chart->place.width = static_cast<int>(std::ceil(scale * (chart->source.width - 1))) + 1;
  chart->place.height = static_cast<int>(std::ceil(scale * (chart->source.height - 1))) + 1;
}

/// Shelves from the highest chart to the lowest. @return the size of the picture.
cv::Size pack(int largest_side_px, std::vector<Chart>* charts) {
  double area = 0.0;
  int width = 1;
  for (const Chart& chart : *charts) {
    area += chart.place.area();
    width = std::max(width, chart.place.width);
  }
  width = std::max(width, std::min(largest_side_px, static_cast<int>(std::ceil(std::sqrt(1.1 * area)))));
  std::vector<std::size_t> order(charts->size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return (*charts)[a].place.height > (*charts)[b].place.height;
  });
  cv::Point next;
  int shelf = 0;
  for (const std::size_t i : order) {
    cv::Rect& place = (*charts)[i].place;
    if (next.x > 0 && next.x + place.width > width) next = {0, next.y + shelf}, shelf = 0;
    place.x = next.x, place.y = next.y;
    next.x += place.width;
    shelf = std::max(shelf, place.height);
  }
  return {width, next.y + shelf};
}

}  // namespace

Eigen::Vector2d pixelOf(const TriangleMesh& mesh, int vertex, const KeyFrame& frame) {
  return frame.camera.project(frame.T_camera_model * Eigen::Vector3d(mesh.vertices.row(vertex).transpose()));
}

Layout layOutCharts(const TriangleMesh& mesh, const EdgeNeighbors& neighbors, const std::vector<int>& label,
                    const std::vector<KeyFrame>& frames, int largest_side_px) {
  Layout layout;
  layout.chart_of.assign(label.size(), -1);
  for (std::size_t t = 0; t < label.size(); ++t) {
    if (layout.chart_of[t] >= 0) continue;
    const int number = static_cast<int>(layout.charts.size());
    Chart chart;
    chart.frame = label[t];
    layout.chart_of[t] = number;
    chart.triangles = {static_cast<int>(t)};
    if (label[t] >= 0)
      chart.triangles = grow(static_cast<int>(t), neighbors, label, &layout.chart_of, number);
    layout.charts.push_back(std::move(chart));
  }
  double scale = 1.0;
  do {
    for (Chart& chart : layout.charts) scaleTo(scale, mesh, frames, &chart);
    layout.size = pack(largest_side_px, &layout.charts);
    scale *= kSmaller;
  } while (std::max(layout.size.width, layout.size.height) > largest_side_px && scale > 0.01);
  return layout;
}

}  // namespace softbody::scanning
