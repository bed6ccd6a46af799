#pragma once

#include <cstdint>
#include <vector>

#include "scanned/contact_shadow.h"
#include "softbody_tracking/tool/tool_description.h"
#include "softbody_virtual_camera/scenes/scene.h"

/// What is around a body that is scanned. World frame: z is up, the body lies at the origin.
namespace softbody::virtual_camera {

/// Table, walls and things on the table. @param scale 1: a desk for a camera 0.45 m from the body.
/// @param table_z height of the table [m]. @param shadow on the table; null: none.
std::vector<Actor> deskActors(double scale, double table_z, const ContactShadow* shadow, std::uint64_t seed);

/// White paper with the sheet's markers, in the sheet's frame. Without markers: an empty A4 sheet.
Actor sheetActor(const ToolDescription& sheet, const ContactShadow& shadow);

}  // namespace softbody::virtual_camera
