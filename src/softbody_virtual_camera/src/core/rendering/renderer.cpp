#include "softbody_virtual_camera/rendering/renderer.h"

#include <algorithm>

#include "softbody_common/images/pixel_labels.h"

namespace softbody::virtual_camera {
namespace {

/// The vertices of the still actors, or of the moving actors.
std::vector<const Points*> select(const std::vector<Points>& vertices, const std::vector<char>& still,
                                  bool wanted) {
  std::vector<const Points*> selected;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (static_cast<bool>(still.at(i)) == wanted) selected.push_back(&vertices[i]);
  }
  return selected;
}

/// The first actor is the body.
std::uint8_t labelOf(const Scene& scene, std::size_t actor) {
  if (actor == 0) return labels::kBody;
  return scene.actors[actor].background ? labels::kBackground : labels::kOccluder;
}

}  // namespace

Renderer::Renderer(const Scene& scene, const Pinhole& camera)
    : body_vertices_(static_cast<int>(scene.actors.at(0).rest.vertices.rows())), moving_(camera) {
  Layer still(camera);
  for (std::size_t i = 0; i < scene.actors.size(); ++i) {
    // The body is always in the moving layer, because its visibility is needed.
    still_.push_back(i > 0 && scene.actors[i].still);
    if (scene.second == i) second_vertices_ = static_cast<int>(scene.actors[i].rest.vertices.rows());
    if (!still_.back() && i < scene.second.value_or(0))
      second_first_ += static_cast<int>(scene.actors[i].rest.vertices.rows());
    (still_.back() ? still : moving_).add(scene.actors[i], labelOf(scene, i));
  }
  const SceneState start = scene.state(0.0);
  still.place(select(start.vertices, still_, true), start.lights);
  backdrop_ = still.draw(emptyCanvas(camera));
}

void Renderer::render(const SceneState& state, RenderedImage* image) {
  place(state);
  moving_.drawColor(backdrop_, &image->color);
  drawDepth(image);
}

void Renderer::renderColor(const SceneState& state, cv::Mat3b* color) {
  place(state);
  moving_.drawColor(backdrop_, color);
}

void Renderer::renderDepth(const SceneState& state, RenderedImage* image) {
  place(state);
  drawDepth(image);
}

void Renderer::place(const SceneState& state) {
  moving_.place(select(state.vertices, still_, false), state.lights);
}

void Renderer::drawDepth(RenderedImage* image) {
  moving_.drawDepth(backdrop_, &inverse_z_);
  image->depth.create(inverse_z_.size());
  for (int v = 0; v < inverse_z_.rows; ++v) {
    std::transform(inverse_z_[v], inverse_z_[v] + inverse_z_.cols, image->depth[v], [](float inverse_z) {
      const float z = 1.0f / inverse_z;
      return inverse_z > 0.0f ? z : 0.0f;
    });
  }
  moving_.drawLabels(&image->labels);
  image->visibility = moving_.visibility(0, body_vertices_, inverse_z_);
  image->second_visibility = moving_.visibility(second_first_, second_vertices_, inverse_z_);
}

}  // namespace softbody::virtual_camera
