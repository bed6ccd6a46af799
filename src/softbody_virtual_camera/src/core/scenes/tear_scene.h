#pragma once

#include "scenes/stage.h"

namespace softbody::virtual_camera {

/// The body is pulled at both ends. The stretch is largest in one cross-section. There the body tears in two
/// when it is 1.5 times as long as at rest (`tear_strain` 0.5). Then both pieces relax, and their ends stay.
Scene tearScene(const Stage& stage);

}  // namespace softbody::virtual_camera
