#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

/// On the table, pressed by a stamp with a known force. The truth is an elastic body.
Play stampPlay(const Stage& stage);

/// A round stamp with a rod. The origin is the middle of its flat side; z points along the rod.
TriangleMesh stampMesh(double radius);
Texture stampPaint();

/// The force that would shorten a column under a round stamp by 8 mm [N], by its height [m].
std::function<double(double height_m)> forceOfStamp(const Stage& stage, double radius_m);

}  // namespace softbody::virtual_camera
