#pragma once

#include "cluttered/draws.h"
#include "scenes/stage.h"

/// Other things than the body.
namespace softbody::virtual_camera {

/// A thing that does not deform, at its place at the start.
struct Thing {
  TriangleMesh mesh;  ///< in its own frame, its origin in the middle
  Eigen::Isometry3d T_body_thing = Eigen::Isometry3d::Identity();
};

/// Painted in one colour that no plain body has, or with blots of other colours on it.
Texture drawnLook(Draws* draws);

/// @param way from the thing's first place, in the body's frame at the start [m].
Prop movedThing(const Stage& stage, const Thing& thing, const Texture& look,
                const std::function<Eigen::Vector3d(double t)>& way);

}  // namespace softbody::virtual_camera
