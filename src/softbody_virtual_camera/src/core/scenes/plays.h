#pragma once

#include "motion/motion_profiles.h"
#include "scenes/stage.h"

/// The motions of the scenes. They use only the body's rest mesh: x is its length, z points up.
namespace softbody::virtual_camera {

Play stillPlay(const Stage& stage);
Play bendPlay(const Stage& stage);
Play twistPlay(const Stage& stage);
Play pushPlay(const Stage& stage);
Play pullPlay(const Stage& stage);
Play shakePlay(const Stage& stage);  ///< rigid; up to 1 m/s and 180 deg/s
Play rigidPlay(const Stage& stage);  ///< 5 cm and 30 deg away, and back
Play fastPlay(const Stage& stage);   ///< bends twice a second and swings at up to 0.7 m/s
Play rollPlay(const Stage& stage);   ///< bends upwards to 14 1/m; a body that is too thick for it, sideways
Play farPlay(const Stage& stage);    ///< bends, then rests for 3 s
Play dimPlay(const Stage& stage);    ///< bends in low light from a lamp that flickers
Play tablePlay(const Stage& stage);  ///< on the table, becomes shorter by 10 %
Play leavePlay(const Stage& stage);  ///< out of view to the left and back

/// A body on the table becomes shorter by 10 % while the plateau lasts. @param poisson_ratio 0: its sides
/// stay.
using BodyDeformation = std::function<Eigen::Vector3d(const Eigen::Vector3d& rest, double t)>;
BodyDeformation shorteningOnTable(const Stage& stage, const Plateau& when, double poisson_ratio);

}  // namespace softbody::virtual_camera
