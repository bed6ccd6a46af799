#pragma once

#include <cstdint>
#include <vector>

#include "softbody_tracking/tool/tool_description.h"
#include "softbody_virtual_camera/scenes/scene.h"

/// What is around a body that is scanned. World frame: z is up, the body lies at the origin.
namespace softbody::virtual_camera {

/// The rectangle that a body at rest covers on the table, in a frame that is turned by `yaw` about z.
struct Footprint {
  Eigen::Vector2d half = Eigen::Vector2d::Zero(), middle = Eigen::Vector2d::Zero();  ///< [m]
};

/// Table, walls and things on the table. @param scale 1: a desk for a camera 0.45 m from the body.
/// @param table_z height of the table [m].
std::vector<Actor> deskActors(double scale, double table_z, const Footprint& body, std::uint64_t seed);

/// White paper with the sheet's markers, in the sheet's frame.
Actor sheetActor(const ToolDescription& sheet, const Footprint& body);

}  // namespace softbody::virtual_camera
