#pragma once

namespace softbody::validation {

/// What a recording must satisfy.
struct CheckLimits {
  double sync_tolerance_s = 0.015;           ///< camera_ingest's parameter of that name
  double slowest_rate_hz = 15.0;             ///< below, fast motion is lost between frames
  double shortest_s = 1.0;                   ///< length of the recording
  double nearest_m = 0.1, farthest_m = 5.0;  ///< camera_ingest's parameters min_depth_m and max_depth_m
  double usual_farthest_m = 4.0;             ///< median depth
  double smallest_valid_share = 0.2;         ///< of the depth pixels
};

}  // namespace softbody::validation
