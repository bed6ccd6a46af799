#include "texture/atlas_drawing.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "texture/pixel_color.h"

namespace softbody::scanning {
namespace {

constexpr float kOutside = -std::numeric_limits<float>::max();
// Texels whose centre is so far outside of a triangle take the image's colour: half of a texel's diagonal, so
// that each triangle has one. Farther out, the image may show the table.
constexpr double kAround = 0.75;

/// A triangle in the texels of its chart.
struct FlatTriangle {
  Eigen::Vector2d corners[3];
  double heights[3] = {};  ///< of each corner over the opposite side
  double area = 0.0;       ///< twice the signed area

  explicit FlatTriangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
      : corners{a, b, c}, area(cross(b - a, c - a)) {
    for (int k = 0; k < 3; ++k)
      heights[k] = std::abs(area) / std::max(1e-9, (corners[(k + 2) % 3] - corners[(k + 1) % 3]).norm());
  }

  static double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
  }

  Eigen::Vector3d weights(const Eigen::Vector2d& p) const {
    Eigen::Vector3d w;
    for (int k = 0; k < 3; ++k) w[k] = cross(corners[(k + 1) % 3] - p, corners[(k + 2) % 3] - p) / area;
    return w;
  }

  /// How far a point is inside of the nearest side; negative: outside [texels].
  double depth(const Eigen::Vector3d& w) const {
    return std::min({w[0] * heights[0], w[1] * heights[1], w[2] * heights[2]});
  }
};

/// One chart's texels.
class ChartCanvas {
 public:
  explicit ChartCanvas(const cv::Size& size) : colors_(size, cv::Vec3f()), inside_(size, kOutside) {}

  /// @param color of a texel and the triangle's weights there.
  template <typename Color>
  void draw(const FlatTriangle& triangle, const Color& color) {
    if (!(std::abs(triangle.area) > 1e-6)) return;
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& corner : triangle.corners) box.extend(corner);
    const auto lowest = [](double x) { return std::max(0, static_cast<int>(std::ceil(x - kAround))); };
    const auto highest = [](double x, int size) {
      return std::min(size - 1, static_cast<int>(std::floor(x + kAround)));
    };
    for (int y = lowest(box.min().y()); y <= highest(box.max().y(), colors_.rows); ++y) {
      for (int x = lowest(box.min().x()); x <= highest(box.max().x(), colors_.cols); ++x) {
        const Eigen::Vector3d weights = triangle.weights({x, y});
        const auto depth = static_cast<float>(triangle.depth(weights));
        if (depth < -kAround || depth <= inside_(y, x)) continue;
        inside_(y, x) = depth;
        const Eigen::Vector3d clamped = weights.cwiseMax(0.0).cwiseMin(1.0);
        colors_(y, x) = color(x, y, Eigen::Vector3d(clamped / clamped.sum()));
      }
    }
  }

  /// Texels beside drawn ones take their mean colour, a ring in each round.
  void addBorder() {
    for (int round = 0; round < kBorder; ++round) {
      const cv::Mat1f before = inside_.clone();
      for (int y = 0; y < colors_.rows; ++y) {
        for (int x = 0; x < colors_.cols; ++x) {
          if (before(y, x) == kOutside) takeFromNeighbors(before, x, y);
        }
      }
    }
  }

  void copyTo(cv::Mat3b picture) const {
    for (int y = 0; y < picture.rows; ++y) {
      for (int x = 0; x < picture.cols; ++x) {
        for (int k = 0; k < 3; ++k) picture(y, x)[k] = cv::saturate_cast<uchar>(colors_(y, x)[k]);
      }
    }
  }

 private:
  void takeFromNeighbors(const cv::Mat1f& drawn, int x, int y) {
    cv::Vec3f sum;
    float count = 0.0f;
    for (int i = std::max(0, y - 1); i <= std::min(drawn.rows - 1, y + 1); ++i) {
      for (int j = std::max(0, x - 1); j <= std::min(drawn.cols - 1, x + 1); ++j) {
        if (drawn(i, j) == kOutside) continue;
        sum += colors_(i, j);
        count += 1.0f;
      }
    }
    if (count == 0.0f) return;
    colors_(y, x) = sum * (1.0f / count);
    inside_(y, x) = -kBorder;
  }

  cv::Mat3f colors_;
  cv::Mat1f inside_;  // how far inside of a triangle the texel is
};

void drawChart(const TriangleMesh& mesh, const Chart& chart, const KeyFrame& frame, const cv::Vec3f& gain,
               const std::vector<CornerColors>& corrections, cv::Mat3b picture) {
  ChartCanvas canvas(chart.place.size());
  const Eigen::Vector2d place(chart.place.x, chart.place.y);
  for (const int t : chart.triangles) {
    const auto corner = [&](int k) -> Eigen::Vector2d {
      return texelOf(chart, pixelOf(mesh, mesh.triangles(t, k), frame)) - place;
    };
    const CornerColors& added = corrections[static_cast<std::size_t>(t)];
    canvas.draw(
        FlatTriangle(corner(0), corner(1), corner(2)), [&](int x, int y, const Eigen::Vector3d& weights) {
          cv::Vec3f color =
              colorAt(frame.color, chart.source.x + x / chart.scale, chart.source.y + y / chart.scale);
          for (int k = 0; k < 3; ++k) {
            color[k] /= gain[k];
            for (int c = 0; c < 3; ++c)
              color[k] += static_cast<float>(weights[c]) * added[static_cast<std::size_t>(c)][k];
          }
          return color;
        });
  }
  canvas.addBorder();
  canvas.copyTo(picture(chart.place));
}

}  // namespace

cv::Mat3b drawSeenCharts(const TriangleMesh& mesh, const Layout& layout, const std::vector<KeyFrame>& frames,
                         const std::vector<cv::Vec3f>& gains, const std::vector<CornerColors>& corrections) {
  cv::Mat3b picture(layout.size, cv::Vec3b(0, 0, 0));
  for (const Chart& chart : layout.charts) {
    if (chart.frame < 0) continue;
    const auto f = static_cast<std::size_t>(chart.frame);
    drawChart(mesh, chart, frames[f], gains[f], corrections, picture);
  }
  return picture;
}

void drawUnseenCharts(const TriangleMesh& mesh, const Layout& layout, const Points& colors,
                      cv::Mat3b* picture) {
  for (const Chart& chart : layout.charts) {
    if (chart.frame >= 0) continue;
    const auto corners = mesh.triangles.row(chart.triangles.front());
    const Eigen::RowVector3d a = colors.row(corners[0]), along_x = colors.row(corners[1]) - a,
                             along_y = colors.row(corners[2]) - a;
    for (int y = 0; y < kUnseenSide; ++y) {
      for (int x = 0; x < kUnseenSide; ++x) {
        const Eigen::RowVector3d color = a + (x - 1) * along_x + (y - 1) * along_y;
        for (int k = 0; k < 3; ++k)
          (*picture)(chart.place.y + y, chart.place.x + x)[k] = cv::saturate_cast<uchar>(color[k]);
      }
    }
  }
}

Eigen::Vector2d cornerTexel(const TriangleMesh& mesh, const Layout& layout,
                            const std::vector<KeyFrame>& frames, int triangle, int corner) {
  const Chart& chart =
      layout.charts[static_cast<std::size_t>(layout.chart_of[static_cast<std::size_t>(triangle)])];
  if (chart.frame < 0)
    return {chart.place.x + (corner == 1 ? 2.0 : 1.0), chart.place.y + (corner == 2 ? 2.0 : 1.0)};
  const KeyFrame& frame = frames[static_cast<std::size_t>(chart.frame)];
  return texelOf(chart, pixelOf(mesh, mesh.triangles(triangle, corner), frame));
}

Points textureCoordinates(const TriangleMesh& mesh, const Layout& layout,
                          const std::vector<KeyFrame>& frames) {
  Points coordinates(3 * mesh.triangles.rows(), 3);
  for (Eigen::Index i = 0; i < coordinates.rows(); ++i) {
    const Eigen::Vector2d texel =
        cornerTexel(mesh, layout, frames, static_cast<int>(i / 3), static_cast<int>(i % 3));
    coordinates.row(i) << (texel.x() + 0.5) / layout.size.width, 1.0 - (texel.y() + 0.5) / layout.size.height,
        0.0;
  }
  return coordinates;
}

}  // namespace softbody::scanning
