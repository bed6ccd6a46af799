#include "texture/painted_mesh.h"

#include <algorithm>
#include <stdexcept>

#include "texture/atlas_drawing.h"
#include "texture/diffused_colors.h"
#include "texture/exposure.h"
#include "texture/pixel_color.h"
#include "texture/view_agreement.h"
#include "texture/view_choice.h"

namespace softbody::scanning {
namespace {

/// Paints what was not seen, from the vertices' colours in the picture.
void paintUnseen(const TriangleMesh& mesh, const Layout& layout, const std::vector<KeyFrame>& frames,
                 cv::Mat3b* picture) {
  Points colors = Points::Zero(mesh.vertices.rows(), 3);
  std::vector<double> counts(static_cast<std::size_t>(mesh.vertices.rows()), 0.0);
  for (int t = 0; t < mesh.triangles.rows(); ++t) {
    const int chart = layout.chart_of[static_cast<std::size_t>(t)];
    for (int k = 0; layout.charts[static_cast<std::size_t>(chart)].frame >= 0 && k < 3; ++k) {
      const int v = mesh.triangles(t, k);
      const Eigen::Vector2d texel = cornerTexel(mesh, layout, frames, t, k);
      const cv::Vec3f color = colorAt(*picture, texel.x(), texel.y());
      colors.row(v) += Eigen::RowVector3d(color[0], color[1], color[2]);
      counts[static_cast<std::size_t>(v)] += 1.0;
    }
  }
  std::vector<bool> known;
  for (std::size_t v = 0; v < counts.size(); ++v) {
    known.push_back(counts[v] > 0.0);
    if (known.back()) colors.row(static_cast<Eigen::Index>(v)) /= counts[v];
  }
  diffuseColors(mesh.triangles, known, &colors);
  drawUnseenCharts(mesh, layout, colors, picture);
}

}  // namespace

PaintedMesh paintMesh(const TriangleMesh& mesh, const std::vector<KeyFrame>& frames,
                      const PaintConfig& config) {
  const EdgeNeighbors neighbors = edgeNeighbors(mesh.triangles);
  TriangleViews views = findViews(mesh, frames, config.depth_tolerance_m);
  if (std::all_of(views.begin(), views.end(), [](const auto& of_triangle) { return of_triangle.empty(); }))
    throw std::invalid_argument(
        "no frame shows any of the object's triangles; its picture cannot be made: check that the frames' "
        "poses fit to their images");
  const std::vector<cv::Vec3f> gains = exposureGains(views, frames.size());
  divideByGains(gains, &views);
  removeOutliers(neighbors, &views);
  PaintedMesh painted;
  painted.mesh = mesh;
  painted.frame = chooseViews(neighbors, views);
  const Layout layout = layOutCharts(mesh, neighbors, painted.frame, frames, config.largest_side_px);
  const std::vector<CornerColors> corrections =
      levelSeams(mesh, layout, compareSeams(mesh, neighbors, layout, frames, gains));
  painted.picture = drawSeenCharts(mesh, layout, frames, gains, corrections);
  paintUnseen(mesh, layout, frames, &painted.picture);
  painted.texture_coordinates = textureCoordinates(mesh, layout, frames);
  return painted;
}

}  // namespace softbody::scanning
