#include "softbody_bringup/virtual_camera/virtual_camera.h"

#include <numeric>

#include "softbody_bringup/virtual_camera/random.h"
#include "softbody_common/tet_geometry.h"

namespace softbody::virtual_camera {
namespace {

MeshTopology topologyOf(const TriangleMesh& rest) {
  MeshTopology topology;
  topology.rest_vertices = rest.vertices;
  topology.triangles = rest.triangles;
  topology.vertex_parents.resize(static_cast<std::size_t>(rest.vertices.rows()));
  std::iota(topology.vertex_parents.begin(), topology.vertex_parents.end(), 0);
  topology.bodies = triangleBodies(rest.triangles, static_cast<int>(rest.vertices.rows()));
  topology.cut.assign(static_cast<std::size_t>(rest.triangles.rows()), false);
  return topology;
}

}  // namespace

Pinhole d435(int width, int height) {
  constexpr double kFocalAt480 = 615.0;  // [px]
  const double focal = kFocalAt480 * height / 480.0;
  return {width, height, focal, focal, width / 2.0, height / 2.0};
}

NoiseOptions noNoise() {
  NoiseOptions noise;
  noise.color.enabled = false;
  noise.depth.disparity_noise = noise.depth.quantization = noise.depth.edge_dropouts = noise.depth.holes =
      false;
  return noise;
}

VirtualCamera::VirtualCamera(Scene scene, const Pinhole& camera, const NoiseOptions& noise,
                             std::uint64_t seed)
    : scene_(std::move(scene)),
      camera_(camera),
      renderer_(scene_, camera),
      color_noise_(noise.color, hash(seed, 101)),
      depth_noise_(noise.depth, hash(seed, 102)),
      topology_(topologyOf(scene_.actors.at(0).rest)) {}

Capture VirtualCamera::capture(int frame, double t) {
  const SceneState state = scene_.state(t);
  renderer_.render(state.vertices, &image_);
  Capture capture;
  capture.color = image_.color.clone();
  color_noise_.apply(frame, &capture.color);
  depth_noise_.apply(frame, camera_.fx, &image_.depth);
  capture.depth_mm = toMillimetres(image_.depth);
  capture.truth.vertices = state.vertices.at(0);
  capture.truth.confidence = image_.visibility;
  capture.T_camera_body = state.T_camera_body;
  return capture;
}

}  // namespace softbody::virtual_camera
