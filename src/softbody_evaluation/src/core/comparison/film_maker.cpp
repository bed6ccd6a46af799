#include "comparison/film_maker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "comparison/overlay_drawing.h"
#include "comparison/side_views.h"
#include "report/plots.h"
#include "softbody_common/time/time.h"

namespace softbody::evaluation {
namespace {

constexpr int kFrames = 36, kSheetStep = 3;  // of the film; of these, every third is on the sheet
constexpr int kColumns = 4, kWidth = 640, kHeight = 480;  // of the sheet; largest size of a picture [px]
constexpr double kMargin = 0.15;                          // around the body, of its extent
constexpr double kNearPlane_m = 0.01;
constexpr int kNoMatch = -1;

/// Up to `count` stamps at equal intervals.
std::set<Nanoseconds> spread(const std::map<Nanoseconds, MeshState>& states, int count) {
  std::vector<Nanoseconds> stamps;
  stamps.reserve(states.size());
  for (const auto& [stamp, state] : states) stamps.push_back(stamp);
  std::set<Nanoseconds> chosen;
  for (int i = 0; i < count && !stamps.empty(); ++i) {
    chosen.insert(
        stamps[static_cast<std::size_t>(i) * (stamps.size() - 1) / static_cast<std::size_t>(count - 1)]);
  }
  return chosen;
}

/// The part of the image that shows the body at all of the stamps. The whole image if the body is never in
/// view.
cv::Rect viewOf(const Pinhole& camera, const std::map<Nanoseconds, MeshState>& states,
                const std::set<Nanoseconds>& stamps) {
  std::vector<cv::Point2f> pixels;
  for (const Nanoseconds stamp : stamps) {
    for (const auto& row : states.at(stamp).vertices.rowwise()) {
      if (row.z() < kNearPlane_m) continue;
      const Eigen::Vector2d pixel = camera.project(row.transpose());
      pixels.emplace_back(static_cast<float>(pixel.x()), static_cast<float>(pixel.y()));
    }
  }
  const cv::Rect image(0, 0, camera.width, camera.height);
  if (pixels.empty()) return image;
  const cv::Rect body = cv::boundingRect(pixels) & image;
  const cv::Point margin(static_cast<int>(kMargin * body.width), static_cast<int>(kMargin * body.height));
  const cv::Rect view = cv::Rect(body.tl() - margin, body.br() + margin) & image;
  return body.empty() ? image : view;
}

cv::Mat3b overlay(const RecordedFrame& frame, const MeshState& state, const MeshTopology& mesh,
                  const cv::Rect& view, int number) {
  const double scale =
      std::min(static_cast<double>(kWidth) / view.width, static_cast<double>(kHeight) / view.height);
  cv::Mat3b picture;
  cv::resize(frame.color(view), picture, cv::Size(), scale, scale,
             scale < 1.0 ? cv::INTER_AREA : cv::INTER_LINEAR);
  Pinhole camera = frame.camera;
  camera.width = picture.cols;
  camera.height = picture.rows;
  camera.fx *= scale;
  camera.fy *= scale;
  camera.cx = (camera.cx - view.x + 0.5) * scale - 0.5;
  camera.cy = (camera.cy - view.y + 0.5) * scale - 0.5;
  drawOutlineAndLines(camera, state.vertices, mesh, &picture);
  cv::putText(picture, fmt::format("frame {}", number), cv::Point(8, 20), cv::FONT_HERSHEY_SIMPLEX, 0.55,
              cv::Scalar(255, 255, 255), 1, cv::LINE_AA);
  return picture;
}

double radiusOf(const Points& vertices) {
  const Eigen::RowVector3d middle = 0.5 * (vertices.colwise().maxCoeff() + vertices.colwise().minCoeff());
  return (vertices.rowwise() - middle).rowwise().norm().maxCoeff();
}

/// The mean of the known errors in words.
std::string meanInWords(const std::vector<float>& errors_m, bool has_truth) {
  double sum = 0.0;
  int known = 0;
  for (const float error : errors_m) {
    if (std::isnan(error)) continue;
    sum += error;
    ++known;
  }
  if (known == 0) return "no vertex was measured";
  return fmt::format("mean distance from the {}: {:.2f} mm", has_truth ? "truth" : "measured depth",
                     1e3 * sum / known);
}

}  // namespace

FilmMaker::FilmMaker(const EvaluatorOptions& options, const SurfaceRecord& result, const SurfaceRecord* truth)
    : options_(options),
      result_(result),
      truth_(truth),
      chosen_(spread(result.states, options.report_folder.empty() ? 0 : kFrames)) {}

std::vector<float> FilmMaker::errorsOf(const MeshState& state, const RecordedFrame& frame,
                                       const cv::Mat1f& rendered) {
  if (truth_ == nullptr) return depthErrors(state, frame, rendered, options_.occluder_m);
  const auto truth = truth_->states.find(frame.stamp);
  if (truth == truth_->states.end())
    return trueErrors(state, state,
                      std::vector<int>(static_cast<std::size_t>(state.vertices.rows()), kNoMatch));
  const MaterialMap& material = materialAt(result_, frame.stamp);
  const auto [matches, fresh] = matches_.try_emplace({&material, state.revision, truth->second.revision});
  if (fresh) {
    matches->second = matchMaterial(material, topologyOf(result_, state), topologyOf(*truth_, truth->second),
                                    options_.cut_vertex_m);
  }
  return trueErrors(ontoVertices(state, truth->second, matches->second), truth->second,
                    matches->second.vertices);
}

void FilmMaker::add(const RecordedFrame& frame, int number, const cv::Mat1f& rendered) {
  if (chosen_.count(frame.stamp) == 0) return;
  const MeshState& state = result_.states.at(frame.stamp);
  const MeshTopology& mesh = topologyOf(result_, state);
  if (film_.empty()) {
    view_ = viewOf(frame.camera, result_.states, chosen_);
    radius_m_ = radiusOf(state.vertices);
  }
  const std::vector<float> errors = errorsOf(state, frame, rendered);
  const double time_s = seconds(frame.stamp - result_.states.begin()->first);
  film_.push_back(
      {frame.stamp,
       fmt::format("frame {}, {:.2f} s: {}", number, time_s, meanInWords(errors, truth_ != nullptr)),
       overlay(frame, state, mesh, view_, number),
       paintSides(state.vertices, mesh.triangles, errors, radius_m_)});
}

cv::Mat3b FilmMaker::sheet() const {
  std::vector<cv::Mat3b> pictures;
  for (std::size_t i = 0; i < film_.size(); i += kSheetStep) pictures.push_back(film_[i].overlay);
  return contactSheet(pictures, kColumns);
}

}  // namespace softbody::evaluation
