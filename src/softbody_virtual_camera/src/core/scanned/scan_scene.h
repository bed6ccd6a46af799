#pragma once

#include <optional>
#include <string>
#include <vector>

#include "softbody_tracking/tool/tool_description.h"
#include "softbody_virtual_camera/scenes/scene.h"
#include "textures/body_paint.h"

/// Recordings of a body at rest, from all sides, to make a mesh of it. All lengths are true: nothing is
/// scaled to the body but the distance of the camera and the size of the room.
namespace softbody::virtual_camera {

struct ScanOptions {
  std::optional<ToolDescription> sheet;  ///< with markers, below the body; none: the table alone
  bool jerks = false;                    ///< the camera is pushed aside at 0.3 m/s, five times
  bool camera_tf = false;                ///< the pose of the camera is known, as on an arm
};

/// walk: a hand-held camera walks round the body. walk_hand: and a hand passes before it. flip: as walk, the
/// body lies on its other side. turntable: the sheet turns with the body.
std::vector<std::string> scanNames();

/// World frame: the centre of the sheet's print, z up. Actors: body, table, walls, things on the table,
/// sheet, hands. @param name without prefix. @param paint of the body.
/// @throw std::invalid_argument if the body is shorter than 50 mm or longer than 2 m, or for jerks on a
/// turntable.
Scene scanScene(const std::string& name, const Body& body, std::uint64_t seed, const BodyPaint& paint,
                const ScanOptions& options);

/// The middle of the bounding box [m].
Eigen::Vector3d middleOf(const Points& points);

}  // namespace softbody::virtual_camera
