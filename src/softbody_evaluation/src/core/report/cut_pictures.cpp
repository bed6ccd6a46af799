#include "report/cut_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "report/plots.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/time/time.h"
#include "softbody_sim/drawing/mesh_drawing.h"

namespace softbody::evaluation {
namespace {

const cv::Size kModelSize(480, 360), kStripSize(480, 360);
const cv::Vec3d kSkin(120, 200, 235), kFace(90, 110, 225);

void label(const std::string& words, cv::Mat3b* picture) {
  cv::putText(*picture, words, cv::Point(10, 24), cv::FONT_HERSHEY_SIMPLEX, 0.6, cv::Scalar(30, 30, 30), 1,
              cv::LINE_AA);
}

std::vector<cv::Vec3d> colorsOf(const MeshTopology& mesh) {
  std::vector<cv::Vec3d> colors;
  for (const bool cut : mesh.cut) colors.push_back(cut ? kFace : kSkin);
  return colors;
}

Triangles skinOf(const MeshTopology& mesh) {
  std::vector<Eigen::Index> skin;
  for (std::size_t f = 0; f < mesh.cut.size(); ++f) {
    if (!mesh.cut[f]) skin.push_back(static_cast<Eigen::Index>(f));
  }
  return mesh.triangles(skin, Eigen::all);
}

/// The first stamp of each revision, in order.
std::vector<Nanoseconds> revisionBegins(const SurfaceRecord& result) {
  std::vector<Nanoseconds> begins;
  std::uint32_t last = 0;
  for (const auto& [stamp, state] : result.states) {
    if (!begins.empty() && state.revision == last) continue;
    begins.push_back(stamp);
    last = state.revision;
  }
  if (begins.size() < 2) throw std::invalid_argument("the body was not cut, so there is nothing to draw");
  return begins;
}

/// The part of the image that shows the body, in the shape of a picture, with its own camera.
struct Window {
  Window(const Pinhole& camera, const Points& vertices) {
    constexpr double kMargin = 1.5;  // body's extents
    double left = camera.width, right = 0.0, top = camera.height, bottom = 0.0;
    for (const auto& row : vertices.rowwise()) {
      const Eigen::Vector2d pixel = camera.project(row.transpose());
      left = std::min(left, pixel.x()), right = std::max(right, pixel.x());
      top = std::min(top, pixel.y()), bottom = std::max(bottom, pixel.y());
    }
    scale = std::min(kStripSize.width / (kMargin * (right - left)),
                     kStripSize.height / (kMargin * (bottom - top)));
    this->camera = {kStripSize.width,
                    kStripSize.height,
                    scale * camera.fx,
                    scale * camera.fy,
                    scale * (camera.cx - 0.5 * (left + right)) + 0.5 * (kStripSize.width - 1),
                    scale * (camera.cy - 0.5 * (top + bottom)) + 0.5 * (kStripSize.height - 1)};
  }

  cv::Mat3b cropped(const RecordedFrame& frame) const {
    cv::Mat3b picture;
    const cv::Mat map = (cv::Mat_<double>(2, 3) << scale, 0.0, camera.cx - scale * frame.camera.cx, 0.0,
                         scale, camera.cy - scale * frame.camera.cy);
    cv::warpAffine(frame.color, picture, map, kStripSize, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return picture;
  }

  double scale = 1.0;
  Pinhole camera;
};

void drawBlade(const Points& blade, const Pinhole& camera, cv::Mat3b* picture) {
  std::vector<cv::Point> corners;
  for (const auto& row : blade.rowwise()) {
    if (row.z() <= 0.01) return;
    const Eigen::Vector2d pixel = camera.project(row.transpose());
    corners.emplace_back(static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y())));
  }
  cv::polylines(*picture, corners, true, cv::Scalar(0, 170, 255), 2, cv::LINE_AA);
}

}  // namespace

cv::Mat3b drawCutModels(const SurfaceRecord& result) {
  revisionBegins(result);
  const MeshTopology& uncut = result.topologies.begin()->second;
  const MeshState& last = result.states.rbegin()->second;
  const MeshTopology& cut = topologyOf(result, last);
  // The same view as of the body at rest.
  const Points deformed = transformed(last.vertices, fitRigid(last.vertices, cut.rest_vertices));
  const View view = viewOf(uncut.rest_vertices, kModelSize);
  std::vector<cv::Mat3b> pictures{
      drawMesh(uncut.rest_vertices, uncut.triangles, {{kSkin}, true, {}}, view),
      drawMesh(cut.rest_vertices, cut.triangles, {colorsOf(cut), true, cutLines(cut)}, view),
      drawMesh(deformed, skinOf(cut), {{kSkin}, true, {}}, view),
      drawMesh(deformed, cut.triangles, {colorsOf(cut), true, {}}, view)};
  for (std::size_t k = 0; k < pictures.size(); ++k)
    label(fmt::format("({})", static_cast<char>('a' + k)), &pictures[k]);
  return contactSheet(pictures, 1);
}

CutStrip::CutStrip(const SurfaceRecord& result, std::map<Nanoseconds, Points> blades)
    : result_(result), blades_(std::move(blades)) {
  const std::vector<Nanoseconds> begins = revisionBegins(result);
  shown_ = {std::prev(result.states.find(begins[1]))->first, begins[(begins.size() + 1) / 2], begins.back(),
            result.states.rbegin()->first};
  shown_.erase(std::unique(shown_.begin(), shown_.end()), shown_.end());
}

void CutStrip::add(const RecordedFrame& frame) {
  if (std::find(shown_.begin(), shown_.end(), frame.stamp) == shown_.end()) return;
  const MeshState& state = result_.states.at(frame.stamp);
  const MeshTopology& mesh = topologyOf(result_, state);
  const Window window(frame.camera, result_.states.at(shown_.back()).vertices);
  images_.push_back(window.cropped(frame));
  drawWireframe(window.camera, state.vertices, mesh.triangles, &images_.back());
  if (const auto blade = blades_.find(frame.stamp); blade != blades_.end())
    drawBlade(blade->second, window.camera, &images_.back());
  meshes_.push_back(drawMesh(state.vertices, mesh.triangles, {colorsOf(mesh), true, cutLines(mesh)},
                             {Eigen::Isometry3d::Identity(), window.camera}));
  label(fmt::format("{:.2f} s, revision {}", seconds(frame.stamp - result_.states.begin()->first),
                    state.revision),
        &meshes_.back());
}

cv::Mat3b CutStrip::picture() const {
  if (images_.size() != shown_.size()) {
    throw std::invalid_argument(fmt::format(
        "{} of the {} frames to draw are not in the recording; check that it is the recording of the result",
        shown_.size() - images_.size(), shown_.size()));
  }
  std::vector<cv::Mat3b> pictures = images_;
  pictures.insert(pictures.end(), meshes_.begin(), meshes_.end());
  return contactSheet(pictures, static_cast<int>(shown_.size()));
}

}  // namespace softbody::evaluation
