#include "elastic/pressing.h"

#include <Eigen/Dense>
#include <utility>

#include "softbody_virtual_camera/bodies/shapes.h"

namespace softbody::virtual_camera {
PressedBody pressedBody(const Stage& stage, const Eigen::Vector3d& x, const Eigen::Vector3d& z) {
  Eigen::Isometry3d T_body_solver = Eigen::Isometry3d::Identity();
  T_body_solver.linear() << x, z.cross(x), z;
  TriangleMesh rest = stage.actors.at(0).rest;
  rest.vertices = transformed(T_body_solver.inverse(), rest.vertices);
  return {T_body_solver, rest, EmbeddedBody(rest, stage.elasticity)};
}

Pressing pressing(const Stage& stage, const std::shared_ptr<const PressedBody>& body,
                  const PressingThing& thing, std::vector<Holder> holders) {
  for (Holder& holder : holders) holder.T_body_frame = body->T_body_solver.inverse() * holder.T_body_frame;
  PressedSolid solid(body->body.solid(), body->rest, thing.stamp, stage.elasticity.youngs_modulus_pa,
                     heldByAny(holders));
  const double largest = thing.largest_n(solid.shape().stamp_m - body->low());
  const auto states =
      std::make_shared<const PressedStates>(body->body, std::move(solid), largest, std::move(holders));
  const auto pose = [=](double t) -> Eigen::Isometry3d {
    return Eigen::Isometry3d(Eigen::Translation3d(thing.stamp.center.x(), thing.stamp.center.y(),
                                                  states->stampHeight(thing.root(t)) + thing.away_m(t)));
  };
  const auto T_camera_thing = [=](double t) -> Eigen::Isometry3d {
    return stage.T_camera_body * body->T_body_solver * pose(t);
  };
  Play play;
  play.material = body->body.material();
  play.shape = [=](double t) -> Points {
    return transformed(body->T_body_solver, body->body.surface(states->moved(thing.root(t))));
  };
  addFrame(thing.name, T_camera_thing, &play);
  play.wrenches = [=](double t) {
    std::vector<ContactWrench> wrenches = states->onHolders(thing.root(t));
    wrenches.push_back(wrenchOn(thing.name, pose(t), states->stamp(thing.root(t))));
    return wrenches;
  };
  play.props = {rigidProp({thing.mesh, thing.paint, 2.0e-3}, T_camera_thing)};
  return {play, states};
}

}  // namespace softbody::virtual_camera
