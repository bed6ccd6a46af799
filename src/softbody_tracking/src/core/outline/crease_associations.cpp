#include "outline/crease_associations.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>

#include "labels/depth_evidence.h"

namespace softbody {
namespace {

constexpr double kSharp = 0.85;      // cosine between the sides' normals, below which light shows a crease
constexpr double kSameSide = 0.95;   // cosine between normals of one side along a line
constexpr int kCreaseReach = 8;      // [px] each way; how far the crease is searched
constexpr int kSideReach = 16;       // [px] each way; how far the sides' colours are measured
constexpr double kFewestOfSide = 4;  // pixels that tell the colour of a side
constexpr double kContrast = 4.0;    // least difference of the sides, in standard deviations of a pixel
constexpr double kGreyNoise = 2.0;   // smallest standard deviation of a channel
constexpr double kTextureLength =
    8.0;                             // [px] neighbouring pixels of a texture are alike over about this length
constexpr double kPixelLimit = 8.0;  // largest log odds of a pixel: any pixel may be wrong

/// The line in the image where the planes of two sides meet: signed distance from a pixel, and the direction
/// across.
struct PlanesMeet {
  Eigen::Vector2d across;  ///< unit
  double distance;         ///< from the pixel along across [px]
};

/// On a plane, the inverse depth is linear in the pixel: 1 / z = n . ray / (n . p).
std::optional<PlanesMeet> meetingLine(const Pinhole& camera, const cv::Point& pixel,
                                      const Eigen::Vector3d& n_a, const Eigen::Vector3d& p_a,
                                      const Eigen::Vector3d& n_b, const Eigen::Vector3d& p_b) {
  const Eigen::Vector3d difference = n_a / n_a.dot(p_a) - n_b / n_b.dot(p_b);
  const Eigen::Vector2d gradient(difference.x() / camera.fx, difference.y() / camera.fy);
  const double length = gradient.norm();
  if (!(length > 0.0)) return std::nullopt;
  const double value = difference.dot(camera.unproject(pixel.x, pixel.y, 1.0));
  return PlanesMeet{gradient / length, -value / length};
}

/// Colours of one side of a crease.
struct SideColors {
  Eigen::Array3d mean = Eigen::Array3d::Zero(), squares = Eigen::Array3d::Zero();
  double count = 0.0;

  void add(const Eigen::Array3d& color) {
    mean += color;
    squares += color * color;
    count += 1.0;
  }
  void finish() {
    mean /= count;
    squares = squares / count - mean * mean;  // variance
  }
};

/// The pixels on a line across a crease.
struct CreaseLine {
  std::vector<double> distances;       ///< from the predicted crease [px]
  std::vector<Eigen::Array3d> colors;  ///< of the same pixels
};

/// Adds the crease between two neighbouring pixels, if there is one. A crease whose normal is nearer to the
/// other direction of the pixel grid is sampled in that direction.
void addSample(const PredictedSurface& surface, const cv::Point& a, const cv::Point& b,
               std::vector<CreaseSample>* samples) {
  const RasterImage& image = surface.image();
  const int triangle_a = image.triangle(a), triangle_b = image.triangle(b);
  if (triangle_a == triangle_b || triangle_a < 0 || triangle_b < 0) return;
  if (!surface.model().isAtCrease(triangle_a) || !surface.model().isAtCrease(triangle_b)) return;
  if (std::abs(image.depth(a) - image.depth(b)) > kSurfaceEnds) return;
  const Eigen::Vector3d n_a = surface.normal(triangle_a), n_b = surface.normal(triangle_b);
  if (n_a.dot(n_b) > kSharp || surface.model().isAtCut(triangle_a) || surface.model().isAtCut(triangle_b))
    return;
  const Eigen::Vector3d p_a = surface.camera().unproject(a.x, a.y, image.depth(a));
  const Eigen::Vector3d p_b = surface.camera().unproject(b.x, b.y, image.depth(b));
  const auto meet = meetingLine(surface.camera(), a, n_a, p_a, n_b, p_b);
  if (!meet) return;
  const Eigen::Vector2d step(b.x - a.x, b.y - a.y);
  const double sign = meet->across.dot(step) < 0.0 ? -1.0 : 1.0;
  if (sign * meet->across.dot(step) < std::sqrt(0.5) || std::abs(meet->distance) > 1.5) return;
  CreaseSample crease;
  crease.pixel = a;
  crease.outward = sign * meet->across;
  crease.to_edge = sign * meet->distance;
  crease.place = surface.materialPoint(triangle_a, a);
  crease.piece = surface.pieceOf(crease.place);
  crease.position = p_a;
  crease.before = n_a;
  crease.behind = n_b;
  samples->push_back(crease);
}

/// The pixels on the line across a crease, as far as the prediction shows the two sides, and the
/// frame neither an occluder nor the background.
/// @return false if the crease is covered, or not in the image.
bool collect(const RgbdFrame& frame, const PredictedSurface& surface, const Labels& labels,
             const CreaseSample& crease, const Eigen::Vector3d& moved, CreaseLine* line) {
  line->distances.clear();
  line->colors.clear();
  const RasterImage& image = surface.image();
  const Eigen::Vector2d start = frame.camera.project(moved), rendered_start(crease.pixel.x, crease.pixel.y);
  const cv::Rect inside(cv::Point(), image.depth.size());
  const auto pixelAt = [&](const Eigen::Vector2d& from, int step) {
    return cv::Point(cvRound(from.x() + step * crease.outward.x()),
                     cvRound(from.y() + step * crease.outward.y()));
  };
  int known = -1;  // triangle with this normal
  Eigen::Vector3d normal;
  const auto isOnSide = [&](int triangle, int step) {
    if (triangle != known) normal = surface.normal(triangle);
    known = triangle;
    return normal.dot(step <= 0 ? crease.before : crease.behind) >= kSameSide;
  };
  const auto usable = [&](int step) {
    const cv::Point pixel = pixelAt(start, step), rendered = pixelAt(rendered_start, step);
    if (!inside.contains(pixel) || !inside.contains(rendered)) return false;
    const int triangle = image.triangle(rendered);
    if (triangle < 0 || (std::abs(step) > 1 && !isOnSide(triangle, step))) return false;
    const std::uint8_t label = labels.at(pixel);
    return label == labels::kBody || label == labels::kUnknown;
  };
  if (!usable(0)) return false;
  int first = 0, last = 0;
  while (first > -kSideReach && usable(first - 1)) --first;
  while (last < kSideReach && usable(last + 1)) ++last;
  for (int step = first; step <= last; ++step) {
    const cv::Point pixel = pixelAt(start, step);
    const double distance = (Eigen::Vector2d(pixel.x, pixel.y) - start).dot(crease.outward) - crease.to_edge;
    if (!line->distances.empty() && distance <= line->distances.back()) continue;
    const cv::Vec3b& color = frame.color(pixel);
    line->distances.push_back(distance);
    line->colors.emplace_back(color[0], color[1], color[2]);
  }
  return true;
}

}  // namespace

CreaseSamples sampleCreases(const PredictedSurface& surface) {
  CreaseSamples result;
  if (!surface.model().hasCreases()) return result;
  const auto [region, spacing] = contourGrid(surface.image());
  result.spacing_px = spacing;
  for (int v = region.y + spacing / 2; v < region.br().y; v += spacing) {
    for (int u = region.x + 1; u < region.br().x; ++u)
      addSample(surface, {u - 1, v}, {u, v}, &result.samples);
  }
  for (int v = region.y + 1; v < region.br().y; ++v) {
    for (int u = region.x + spacing / 2; u < region.br().x; u += spacing)
      addSample(surface, {u, v - 1}, {u, v}, &result.samples);
  }
  return result;
}

std::vector<Association> associateCreases(const RgbdFrame& frame, const PredictedSurface& surface,
                                          const CreaseSamples& samples, const RigidMotions& motions,
                                          const Labels& labels, const ContourWeight& weight) {
  std::vector<Association> associations;
  CreaseLine line;
  std::vector<LinePixel> pixels;
  for (const CreaseSample& crease : samples.samples) {
    const Eigen::Vector3d moved = motions[crease.piece] * crease.position;
    if (!(moved.z() > 0.0) || !collect(frame, surface, labels, crease, moved, &line)) continue;
    SideColors before, behind;
    for (std::size_t i = 0; i < line.distances.size(); ++i) {
      if (line.distances[i] < -0.5 * kCreaseReach) before.add(line.colors[i]);
      if (line.distances[i] > 0.5 * kCreaseReach) behind.add(line.colors[i]);
    }
    if (before.count < kFewestOfSide || behind.count < kFewestOfSide) continue;
    before.finish();
    behind.finish();
    const Eigen::Array3d variance =
        kGreyNoise * kGreyNoise + kTextureLength * 0.5 * (before.squares + behind.squares);
    if (((before.mean - behind.mean).square() / variance).sum() < kContrast * kContrast) continue;
    pixels.clear();
    for (std::size_t i = 0; i < line.distances.size(); ++i) {
      if (std::abs(line.distances[i]) > kCreaseReach) continue;
      const Eigen::Array3d to_before = line.colors[i] - before.mean, to_behind = line.colors[i] - behind.mean;
      const double log_odds = ((to_behind.square() - to_before.square()) / (2.0 * variance)).sum();
      pixels.push_back({line.distances[i], std::clamp(log_odds, -kPixelLimit, kPixelLimit)});
    }
    const double pixel_m = moved.z() / frame.camera.fx;
    const ContourEnd added = contourPosterior(pixels, predictionVariance(labels.error_m / pixel_m)).added;
    if (std::isinf(added.variance)) continue;
    associations.push_back(
        contourAssociation(frame.camera, crease, moved, added, weight, samples.spacing_px));
  }
  return associations;
}

}  // namespace softbody
