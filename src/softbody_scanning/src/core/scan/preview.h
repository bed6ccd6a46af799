#pragma once

#include "softbody_scanning/scan/scanned_body.h"

namespace softbody::scanning {

/// The surface so far, in coarse voxels and from a few of the frames: takes about a second.
/// @throw std::invalid_argument as scanBody.
RegisteredSurface previewOf(PosedRecording recording);

}  // namespace softbody::scanning
