#include "softbody_virtual_camera/camera/virtual_camera.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "softbody_common/statistics/random.h"
#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
namespace {

/// The body after an edit: new faces show no picture.
Body editedBody(const Body& body, const Edit& edit) {
  Body edited{{edit.topology.rest_vertices, edit.topology.triangles}, body.skin};
  edited.skin.coordinates = edit.topology.texture_coordinates;
  if (body.skin.picture.empty()) return edited;
  edited.skin.picture.clear();
  for (const int parent : edit.triangle_parents) {
    edited.skin.picture.push_back(parent < 0 ? -1 : body.skin.picture[static_cast<std::size_t>(parent)]);
  }
  return edited;
}

/// Farthest way of a vertex on the image [px]; what is not before the camera at both times does not count.
double largestMotion(const Pinhole& camera, const SceneState& from, const SceneState& to) {
  constexpr double kNear = 0.05;  // [m]
  double largest = 0.0;
  for (std::size_t actor = 0; actor < from.vertices.size(); ++actor) {
    const Eigen::Index common = std::min(from.vertices[actor].rows(), to.vertices[actor].rows());
    for (Eigen::Index i = 0; i < common; ++i) {
      const Eigen::Vector3d a = from.vertices[actor].row(i), b = to.vertices[actor].row(i);
      if (a.z() > kNear && b.z() > kNear) {
        largest = std::max(largest, (camera.project(a) - camera.project(b)).norm());
      }
    }
  }
  return largest;
}

/// The exact shape of an actor, in the frame of the truth.
MeshState truthOf(const SceneState& state, std::size_t actor, const std::vector<float>& visibility) {
  const Points& vertices = state.vertices.at(actor);
  MeshState truth;
  truth.vertices = state.T_world_camera ? transformed(*state.T_world_camera, vertices) : vertices;
  truth.confidence = visibility;
  return truth;
}

ColorNoiseOptions amplified(ColorNoiseOptions noise, double factor) {
  noise.std_dark *= factor;
  noise.std_bright *= factor;
  return noise;
}

}  // namespace

Pinhole d435(int width, int height) {
  constexpr double kFocalAt480 = 615.0;  // [px]
  const double focal = kFocalAt480 * height / 480.0;
  return {width, height, focal, focal, width / 2.0, height / 2.0};
}

NoiseOptions noNoise() {
  NoiseOptions noise;
  noise.exposure.enabled = noise.blur.enabled = noise.color.enabled = false;
  noise.wrench.noise = false;
  noise.depth.disparity_noise = noise.depth.quantization = noise.depth.edge_dropouts = noise.depth.holes =
      false;
  return noise;
}

VirtualCamera::VirtualCamera(Scene scene, const Pinhole& camera, const NoiseOptions& noise,
                             std::uint64_t seed)
    : scene_(std::move(scene)),
      camera_(camera),
      blur_(noise.blur),
      exposure_drift_(noise.exposure, hash(seed, 103)),
      color_noise_(amplified(noise.color, scene_.color_noise), hash(seed, 101)),
      depth_noise_(noise.depth, hash(seed, 102)),
      wrench_sensor_(noise.wrench, hash(seed, 104)) {
  const Body body{scene_.actors.at(0).rest, scene_.actors.at(0).skin};
  topologies_.push_back(topologyOf(body));
  renderers_.emplace_back(scene_, camera);
  for (const Edit& edit : scene_.edits) {
    Scene edited = scene_;
    const Body after = editedBody(body, edit);
    edited.actors.at(0).rest = after.rest;
    edited.actors.at(0).skin = after.skin;
    topologies_.push_back(edit.topology);
    renderers_.emplace_back(edited, camera);
  }
}

Capture VirtualCamera::capture(int frame, double t) {
  const SceneState state = scene_.state(t);
  Capture capture;
  Renderer& renderer = renderers_.at(state.revision);
  const int images = imagesAt(t, state);
  if (images == 1) {
    renderer.render(state, &image_);
    capture.color = image_.color.clone();
  } else {
    renderer.renderDepth(state, &image_);
    capture.color = blurredColor(t, images);
  }
  if (state.brightness != 1.0) capture.color *= state.brightness;
  exposure_drift_.apply(t, &capture.color);
  color_noise_.apply(frame, &capture.color);
  depth_noise_.apply(frame, camera_.fx, &image_.depth);
  capture.depth_mm = toMillimetres(image_.depth);
  capture.labels = image_.labels.clone();
  capture.truth = truthOf(state, 0, image_.visibility);
  capture.truth.revision = state.revision;
  if (scene_.second) capture.second = truthOf(state, *scene_.second, image_.second_visibility);
  capture.T_camera_second = state.T_camera_second;
  capture.links = state.links;
  capture.T_camera_body = state.T_camera_body;
  capture.T_camera_tool = state.T_camera_tool;
  capture.gripper = state.gripper;
  capture.forces = state.forces;
  capture.frames = state.frames;
  capture.true_wrenches = state.wrenches;
  capture.wrenches = wrench_sensor_.measured(frame, t, state.wrenches);
  if (state.forces && state.T_world_camera)
    capture.forces = transformed(*state.T_world_camera, *state.forces);
  capture.T_world_camera = state.T_world_camera;
  return capture;
}

std::optional<MeshTopology> VirtualCamera::secondTopology() const {
  if (!scene_.second) return std::nullopt;
  const Actor& second = scene_.actors.at(*scene_.second);
  return topologyOf({second.rest, second.skin});
}

int VirtualCamera::imagesAt(double t, const SceneState& state) const {
  if (!blur_.enabled) return 1;
  const auto closed = scene_.state(t + 0.5 * blur_.exposure_s);
  return blurImages(blur_, 2.0 * largestMotion(camera_, state, closed));
}

cv::Mat3b VirtualCamera::blurredColor(double t, int images) {
  cv::Mat3f sum(camera_.height, camera_.width, cv::Vec3f(0.0f, 0.0f, 0.0f));
  for (int i = 0; i < images; ++i) {
    const double offset = blur_.exposure_s * ((i + 0.5) / images - 0.5);
    const SceneState state = scene_.state(std::max(0.0, t + offset));
    renderers_.at(state.revision).renderColor(state, &image_.color);
    cv::accumulate(image_.color, sum);
  }
  cv::Mat3b color;
  sum.convertTo(color, CV_8U, 1.0 / images);
  return color;
}

}  // namespace softbody::virtual_camera
