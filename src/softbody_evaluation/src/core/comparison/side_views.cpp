#include "comparison/side_views.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "report/plots.h"
#include "softbody_sim/drawing/mesh_drawing.h"

namespace softbody::evaluation {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr double kFullScale_m = 0.010;  ///< error of the last colour
constexpr double kDistance = 6.0;       ///< of the camera from the body, over its radius
constexpr double kSeen = 0.005;         ///< relative depth by which a visible vertex may lie behind the mesh
const cv::Size kSide(240, 200);
const cv::Vec3d kGrey(190, 190, 190);
const char* const kNames[] = {"camera's side", "left", "back", "right"};

/// Colours (BGR) from no error to kFullScale_m.
cv::Mat3b colorScale() {
  cv::Mat1b values(1, 256);
  for (int i = 0; i < 256; ++i) values(0, i) = static_cast<unsigned char>(i);
  cv::Mat3b colors;
  cv::applyColorMap(values, colors, cv::COLORMAP_TURBO);
  return colors;
}

/// The colour of each triangle: the mean error of its known corners.
std::vector<cv::Vec3d> colorsOf(const Triangles& triangles, const std::vector<float>& errors_m) {
  const cv::Mat3b scale = colorScale();
  std::vector<cv::Vec3d> colors;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    double sum = 0.0;
    int known = 0;
    for (int k = 0; k < 3; ++k) {
      const float error = errors_m.at(static_cast<std::size_t>(triangles(f, k)));
      if (std::isnan(error)) continue;
      sum += error;
      ++known;
    }
    const double share = known == 0 ? 0.0 : std::min(1.0, sum / known / kFullScale_m);
    colors.push_back(known == 0 ? kGrey : cv::Vec3d(scale(0, static_cast<int>(255.0 * share))));
  }
  return colors;
}

/// A camera that sees the body from a side: turned about the camera's vertical axis (y) by quarters.
View sideView(const Eigen::Vector3d& middle, double radius_m, int quarters) {
  View view;
  view.T_camera_mesh.linear() =
      Eigen::AngleAxisd(-0.5 * M_PI * quarters, Eigen::Vector3d::UnitY()).toRotationMatrix();
  view.T_camera_mesh.translation() =
      kDistance * radius_m * Eigen::Vector3d::UnitZ() - view.T_camera_mesh.linear() * middle;
  const double focal = 0.48 * kDistance * std::min(kSide.width, kSide.height);
  view.camera = {kSide.width, kSide.height, focal, focal, 0.5 * (kSide.width - 1), 0.5 * (kSide.height - 1)};
  return view;
}

void write(const std::string& words, const cv::Point& place, cv::Mat3b* image) {
  cv::putText(*image, words, place, cv::FONT_HERSHEY_SIMPLEX, 0.42, cv::Scalar(30, 30, 30), 1, cv::LINE_AA);
}

/// The colours with their errors, as wide as two sides.
cv::Mat3b legend() {
  cv::Mat3b image(40, 2 * kSide.width, cv::Vec3b(255, 255, 255));
  const cv::Rect bar(20, 4, image.cols - 40, 12);
  cv::resize(colorScale(), image(bar), bar.size(), 0.0, 0.0, cv::INTER_NEAREST);
  write("0 mm", cv::Point(bar.x, 34), &image);
  write(fmt::format("{:g} mm or more", 1e3 * kFullScale_m), cv::Point(bar.br().x - 110, 34), &image);
  return image;
}

}  // namespace

std::vector<float> trueErrors(const MeshState& state, const MeshState& truth,
                              const std::vector<int>& matches) {
  std::vector<float> errors(matches.size(), kUnknown);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (matches[i] < 0) continue;
    const auto row = static_cast<Eigen::Index>(i);
    errors[i] = static_cast<float>((state.vertices.row(row) - truth.vertices.row(matches[i])).norm());
  }
  return errors;
}

std::vector<float> depthErrors(const MeshState& state, const RecordedFrame& frame, const cv::Mat1f& rendered,
                               double occluder_m) {
  std::vector<float> errors(static_cast<std::size_t>(state.vertices.rows()), kUnknown);
  if (frame.depth.empty()) return errors;
  for (Eigen::Index i = 0; i < state.vertices.rows(); ++i) {
    const Eigen::Vector3d p = state.vertices.row(i);
    if (p.z() <= 0.01) continue;
    const Eigen::Vector2d pixel = frame.camera.project(p);
    if (!frame.camera.contains(pixel.x(), pixel.y())) continue;
    const cv::Point at(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
    const float z = frame.depth(at);
    const bool measured = z > 0.0f && std::isfinite(z) && p.z() - z <= occluder_m;
    // A vertex on the outline has no mesh behind its pixel; there the depth is of the background.
    if (measured && rendered(at) > 0.0f && p.z() < (1.0 + kSeen) * rendered(at))
      errors[static_cast<std::size_t>(i)] = std::abs(rendered(at) - z);
  }
  return errors;
}

cv::Mat3b paintSides(const Points& vertices, const Triangles& triangles, const std::vector<float>& errors_m,
                     double radius_m) {
  const Eigen::Vector3d middle =
      0.5 * (vertices.colwise().minCoeff() + vertices.colwise().maxCoeff()).transpose();
  const MeshPaint paint{colorsOf(triangles, errors_m), false, {}};
  std::vector<cv::Mat3b> sides;
  for (int quarters = 0; quarters < 4; ++quarters) {
    sides.push_back(drawMesh(vertices, triangles, paint, sideView(middle, radius_m, quarters)));
    write(kNames[quarters], cv::Point(6, 14), &sides.back());
  }
  cv::Mat3b image = contactSheet(sides, 2);
  image.push_back(legend());
  return image;
}

}  // namespace softbody::evaluation
