#pragma once

#include <vector>

#include "softbody_common/types.h"
#include "softbody_sim/constraints/obstacle.h"

namespace softbody {

/// A point of the body's surface that feels contact.
struct ContactPoint {
  MaterialPoint place;
  double area = 0.0;  ///< its share of the rest surface [m^2]
};

/// A lattice of points on the surface, finer than `spacing_m` (at most 8 to an edge), its vertices among
/// them.
std::vector<ContactPoint> sampleContactPoints(const TetTopology& topology, double spacing_m);

/// A contact as an energy sees it: the point may not cross the plane, which is the obstacle's tangent plane.
struct Contact {
  int point = -1;                                      ///< index into the contact points
  int obstacle = -1;                                   ///< index into the obstacles
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< on the obstacle's surface [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();   ///< outward
};

/// One contact for each pair of point and obstacle closer than `reach_m`, obstacle by obstacle and point by
/// point. A point that was outside is stopped where its way meets the obstacle, seen from the obstacle as
/// both move, so that nothing gets through a thin or fast one between two steps; any other belongs to the
/// nearest place on the surface.
/// @param before, after vertices at the step's start and as they are now; @param before_poses of the
/// obstacles at the step's start.
void findContacts(const std::vector<ContactPoint>& points, const Tets& tets, const Points& before,
                  const Points& after, const std::vector<Obstacle>& obstacles,
                  const std::vector<Eigen::Isometry3d>& before_poses, double reach_m,
                  std::vector<Contact>* contacts);

/// Adds those of `earlier` that were not found again: a point that a contact has pushed out of the obstacle's
/// way would otherwise fall back into it. Both as findContacts orders them.
void addEarlierContacts(const std::vector<Contact>& earlier, std::vector<Contact>* contacts);

/// The order of findContacts.
bool isOrderedBefore(const Contact& a, const Contact& b);

}  // namespace softbody
