#include "texture/charts.h"

#include <gtest/gtest.h>

#include "fixtures/painted_ball.h"
#include "texture/exposure.h"
#include "texture/seam_levelling.h"
#include "texture/view_choice.h"

namespace softbody::scanning {
namespace {

/// A ball, its frames, and its charts.
struct Scene {
  explicit Scene(int largest_side_px = 4096) {
    views = findViews(mesh, frames, 0.005);
    labels = chooseViews(neighbors, views);
    layout = layOutCharts(mesh, neighbors, labels, frames, largest_side_px);
  }

  TriangleMesh mesh = ballMesh();
  std::vector<KeyFrame> frames = walkAround(mesh);
  EdgeNeighbors neighbors = edgeNeighbors(mesh.triangles);
  TriangleViews views;
  std::vector<int> labels;
  Layout layout;
};

void expectEachTexelBelongsToOneChart(const Layout& layout) {
  cv::Mat1i owner(layout.size, -1);
  for (std::size_t c = 0; c < layout.charts.size(); ++c) {
    const cv::Rect& place = layout.charts[c].place;
    ASSERT_EQ(place & cv::Rect({}, layout.size), place) << c;
    EXPECT_EQ(cv::countNonZero(owner(place) != -1), 0) << c;
    owner(place).setTo(static_cast<int>(c));
  }
}

TEST(Charts, EachTexelBelongsToOneChart) {
  for (const int largest : {4096, 400, 200}) {
    const Scene scene(largest);
    EXPECT_LE(std::max(scene.layout.size.width, scene.layout.size.height), largest);
    expectEachTexelBelongsToOneChart(scene.layout);
  }
}

TEST(Charts, TrianglesLieInsideTheirChartWithABorder) {
  for (const int largest : {4096, 300}) {
    const Scene scene(largest);
    for (const Chart& chart : scene.layout.charts) {
      if (chart.frame < 0) continue;
      const KeyFrame& frame = scene.frames[static_cast<std::size_t>(chart.frame)];
      for (const int t : chart.triangles) {
        for (int k = 0; k < 3; ++k) {
          const Eigen::Vector2d texel =
              texelOf(chart, pixelOf(scene.mesh, scene.mesh.triangles(t, k), frame));
          EXPECT_GE(texel.x(), chart.place.x + kBorder - 1e-9);
          EXPECT_GE(texel.y(), chart.place.y + kBorder - 1e-9);
          EXPECT_LE(texel.x(), chart.place.br().x - 1 - kBorder + 1.0);
          EXPECT_LE(texel.y(), chart.place.br().y - 1 - kBorder + 1.0);
        }
      }
    }
  }
}

TEST(Charts, AChartIsOfOneFrameAndConnected) {
  const Scene scene;
  std::size_t triangles = 0, seen = 0;
  for (const Chart& chart : scene.layout.charts) {
    triangles += chart.triangles.size();
    seen += chart.frame >= 0 ? 1 : 0;
    for (const int t : chart.triangles) EXPECT_EQ(scene.labels[static_cast<std::size_t>(t)], chart.frame);
    EXPECT_TRUE(chart.frame >= 0 || chart.triangles.size() == 1);
  }
  EXPECT_EQ(triangles, static_cast<std::size_t>(scene.mesh.triangles.rows()));
  EXPECT_LT(seen, 40u) << "the seams were not smoothed";
}

TEST(SeamLevelling, DarkCornersOfTheImagesLeaveSmallSeams) {
  Scene scene;
  for (KeyFrame& frame : scene.frames) {
    for (int v = 0; v < frame.color.rows; ++v) {
      for (int u = 0; u < frame.color.cols; ++u) {
        const double light = 1.0 - 0.3 * (std::pow((u - 100) / 100.0, 2) + std::pow((v - 120) / 100.0, 2));
        frame.color(v, u) *= std::max(0.1, light);
      }
    }
  }
  const std::vector<cv::Vec3f> none(scene.frames.size(), cv::Vec3f(1, 1, 1));
  const auto seams = compareSeams(scene.mesh, scene.neighbors, scene.layout, scene.frames, none);
  const auto corrections = levelSeams(scene.mesh, scene.layout, seams);
  std::map<std::pair<int, int>, cv::Vec3f> added;
  for (std::size_t t = 0; t < corrections.size(); ++t) {
    for (int k = 0; k < 3; ++k)
      added[{scene.layout.chart_of[t], scene.mesh.triangles(static_cast<Eigen::Index>(t), k)}] =
          corrections[t][static_cast<std::size_t>(k)];
  }
  double before = 0.0, after = 0.0;
  for (const SeamVertex& seam : seams) {
    before += cv::norm(seam.difference);
    after += cv::norm(seam.difference + added[{seam.first, seam.vertex}] - added[{seam.second, seam.vertex}]);
  }
  EXPECT_GT(before / static_cast<double>(seams.size()), 5.0);
  EXPECT_LT(after, 0.2 * before);
}

}  // namespace
}  // namespace softbody::scanning
