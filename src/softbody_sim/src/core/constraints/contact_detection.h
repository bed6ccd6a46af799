#pragma once

#include <limits>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/constraints/obstacle.h"

namespace softbody {

/// A point of the body's surface that is tested for contact.
struct ContactPoint {
  MaterialPoint place;
  double area = 0.0;  ///< of the rest surface that it represents [m^2]
};

/// Samples the surface with a lattice of points, vertices included, with at most 8 intervals per edge.
/// @param spacing_m upper limit of the spacing, if 8 intervals suffice.
std::vector<ContactPoint> sampleContactPoints(const TetTopology& topology, double spacing_m);

/// The tet of each surface triangle.
std::vector<int> tetsOfSurface(const TetTopology& topology);

/// A contact as a constraint: the point must not cross the obstacle's tangent plane.
struct Contact {
  int point = -1;                                      ///< index into the contact points
  int obstacle = -1;                                   ///< index into the obstacles, or kBody
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the obstacle's surface [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< outward
  Eigen::Vector3d anchor =
      Eigen::Vector3d::Zero();  ///< where the obstacle carries the point if it sticks [m]
  double depth = 0.0;     ///< that gives the largest force of friction; found at the start of the step [m]
  double friction = 0.0;  ///< coefficient
  double lift = 0.0;      ///< of the plane above the obstacle, so that the point itself does not sink in [m]
  Eigen::Vector3d slip = Eigen::Vector3d::Zero();  ///< of the point from its anchor, obstacle's frame [m]
  /// Of a contact with the body itself: the place that the point touches. Position and anchor are relative to
  /// it, and the slip is in the frame of the targets.
  MaterialPoint other = {};

  static constexpr int kBody = std::numeric_limits<int>::max();  ///< instead of an obstacle
  bool isWithBody() const { return obstacle == kBody; }
};

/// What a step leaves to the next.
struct ContactState {
  std::vector<Eigen::Isometry3d> obstacle_poses;
  std::vector<Contact> contacts;  ///< that push, ordered as by findContacts
};

/// One contact for each pair of point and obstacle closer than `reach_m`, sorted by obstacle, then by point.
/// A point touches the surface point that is nearest to it now. Detection is continuous: if its path,
/// relative to the moving obstacle, has passed through the obstacle or comes nearer to another side, it
/// touches where the path first meets the obstacle. So no point passes through a thin or fast obstacle
/// between two steps.
/// @param before, after vertices at the start of the step and now [m].
/// @param before_poses of the obstacles at the start of the step.
void findContacts(const std::vector<ContactPoint>& points, const Tets& tets, const Points& before,
                  const Points& after, const std::vector<Obstacle>& obstacles,
                  const std::vector<Eigen::Isometry3d>& before_poses, double reach_m,
                  std::vector<Contact>* contacts);

/// Adds the contacts of `earlier` that were not found again, and gives its forces (lift, depth) to the
/// others. Otherwise a point would fall back after a contact has pushed it out of the obstacle's path. Both
/// lists are ordered as by findContacts.
void keepEarlierContacts(const std::vector<Contact>& earlier, std::vector<Contact>* contacts);

/// The order of findContacts.
bool isOrderedBefore(const Contact& a, const Contact& b);

}  // namespace softbody
