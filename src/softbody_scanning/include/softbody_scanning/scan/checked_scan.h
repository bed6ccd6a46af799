#pragma once

#include "softbody_scanning/scan/scanned_body.h"

namespace softbody::scanning {

/// A body, and what was found out about the recording on the way.
struct CheckedScan {
  ScannedBody body;
  int left_out = 0;               ///< key frames that do not agree with the others
  double seen_share = 0.0;        ///< of the surface, 0..1
  double upper_seen_share = 0.0;  ///< of the surface without what lay on the table
};

/// Scans; leaves out frames that do not agree with the surface and scans again.
/// @throw std::invalid_argument as scanBody, and if the object moved meanwhile or too little of it was seen.
CheckedScan scanAndCheck(std::vector<PosedRecording> recordings, const ScanSettings& settings);

}  // namespace softbody::scanning
