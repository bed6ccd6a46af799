#pragma once

#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "elastic/embedded_body.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody::virtual_camera {

/// A hand with two fingers, as a body feels it. All poses are in the world.
struct HandContact {
  Eigen::Isometry3d T_world_hand = Eigen::Isometry3d::Identity();
  std::array<Eigen::Isometry3d, 2> T_world_fingers;
  bool closed = false;  ///< what lies between the fingers moves with the hand
};

/// Sizes of a hand's parts [m].
struct HandShape {
  Eigen::Vector3d finger;       ///< edges, in the finger's frame
  Eigen::Vector3d half_inside;  ///< of the space between the closed fingers, in the hand's frame
};

/// An elastic body on a table that yields to a hand. Its cells are cut into tets, finer than those of a
/// tracker. The world's z is up, and the table is its xy plane.
class AnsweringBody {
 public:
  /// @param rest closed, in the body's frame. @param gravity_m_s2 along -z of the world.
  AnsweringBody(const TriangleMesh& rest, const Elasticity& elasticity, const Eigen::Isometry3d& T_world_body,
                double gravity_m_s2, const HandShape& hand);

  /// Advances by kAnswerStep_s. @param hand at the end of the step.
  void step(const HandContact& hand);

  /// The vertices of the body's surface, in the world.
  Points surface() const;
  TrueMaterial material() const { return body_.material(); }
  /// What the body does to the table.
  Wrench onTable() const;

 private:
  struct Held {
    int node;
    Eigen::Vector3d in_hand;
  };
  void grip(const Eigen::Isometry3d& T_world_hand);
  Surroundings surroundings(const HandContact& hand) const;

  EmbeddedBody body_;
  Eigen::Isometry3d T_world_body_;
  HandShape hand_;
  Simulator simulator_;
  Nanoseconds stamp_ = 0;
  bool closed_ = false;
  std::vector<Held> held_;
};

constexpr double kAnswerStep_s = 1.0 / 30.0;
constexpr double kAnswerFriction = 0.5;  ///< of table and fingers

}  // namespace softbody::virtual_camera
