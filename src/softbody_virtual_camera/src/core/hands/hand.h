#pragma once

#include <functional>
#include <vector>

#include "hands/body_profile.h"

/// A hand that holds one end of a body. All points are in the body's frame [m].
namespace softbody::virtual_camera {

using Deformation = std::function<Eigen::Vector3d(const Eigen::Vector3d& rest)>;

/// Where a hand holds the body at rest.
struct Grip {
  Eigen::Vector3d center;          ///< of the end
  Eigen::Vector3d outward;         ///< unit vector from the body to the arm
  Eigen::Vector3d fingers, thumb;  ///< unit vectors from the body to the pads, normal to outward
  bool flat_palm = false;          ///< the palm lies on the end; otherwise it is beyond the end
};

/// Fingers and thumb are opposite, across the thinner side of the body.
Grip holdingGrip(const Points& body, const Eigen::Vector3d& outward);
/// The palm lies on the end, and the thumb on the broader side.
Grip pushingGrip(const Points& body, const Eigen::Vector3d& outward);

/// A finger or the thumb: three joints on the body, from the tip on, and two in the palm.
struct Digit {
  Eigen::Vector3d side;           ///< unit vector from the body to the pads
  Eigen::Vector3d start;          ///< of the line under the pads, at the end
  BodyProfile profile;            ///< of the body over this line
  std::vector<double> joints;     ///< their distances from the end
  Eigen::Vector3d knuckle, root;  ///< relative to the grip's centre
};

struct Hand {
  Grip grip;
  std::vector<Digit> digits;  ///< four fingers, then the thumb
  TriangleMesh mesh;          ///< capsules, in the pose that touches the body at rest
};
Hand makeHand(const TriangleMesh& body, const Grip& grip);

/// What the hand does at one time.
struct HandPose {
  Deformation body;     ///< the hand moves with the body
  double strain = 0.0;  ///< of the body along its length
  double open = 0.0;    ///< 0: fingers and thumb touch the body; 1: they are spread
  double away_m = 0.0;  ///< distance outwards
};
/// The vertices of the hand's mesh.
Points posed(const Hand& hand, const HandPose& pose);

}  // namespace softbody::virtual_camera
