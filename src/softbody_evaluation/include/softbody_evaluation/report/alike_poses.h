#pragma once

namespace softbody::evaluation {

/// The tracker found several poses that look alike, and took one of them.
struct AlikePoses {
  int poses = 2;
  /// What follows is known only with a truth.
  bool compared = false;
  bool same_shape = true;  ///< the mesh looks the same at the true pose; otherwise the pose is an error
  double turn_rad = 0.0;   ///< from the true pose
};

}  // namespace softbody::evaluation
