#include "cluttered/looks.h"

#include <Eigen/Dense>

namespace softbody::virtual_camera {
namespace {

const Eigen::Vector3f kPaints[] = {{0.68f, 0.20f, 0.16f}, {0.16f, 0.34f, 0.64f}, {0.18f, 0.46f, 0.24f},
                                   {0.80f, 0.64f, 0.14f}, {0.16f, 0.17f, 0.19f}, {0.48f, 0.22f, 0.52f}};

}  // namespace

Texture drawnLook(Draws* draws) {
  constexpr float kBlots = 0.35f;  // share of the blots' colour
  const Eigen::Vector3f paint = kPaints[draws->below(std::size(kPaints))];
  const float blots = draws->below(2) == 0 ? 0.0f : kBlots;
  return [=, cells = cellTexture(draws->next())](const Eigen::Vector3d& place) -> Eigen::Vector3f {
    return blots == 0.0f ? paint : Eigen::Vector3f((1.0f - blots) * paint + blots * cells(place));
  };
}

Prop movedThing(const Stage& stage, const Thing& thing, const Texture& look,
                const std::function<Eigen::Vector3d(double t)>& way) {
  constexpr double kTexel = 1.0e-3;  // [m]
  return rigidProp({thing.mesh, look, kTexel}, [=, T_camera_body = stage.T_camera_body](double t) {
    return T_camera_body * Eigen::Translation3d(way(t)) * thing.T_body_thing;
  });
}

}  // namespace softbody::virtual_camera
