#pragma once

#include <functional>
#include <memory>
#include <string>

#include "elastic/pressed_states.h"
#include "scenes/stage.h"

namespace softbody::virtual_camera {

/// A body in the frame of its solver, whose z axis points against the thing that presses it.
struct PressedBody {
  Eigen::Isometry3d T_body_solver;
  TriangleMesh rest;  ///< in the solver's frame
  EmbeddedBody body;

  double low() const { return rest.vertices.col(2).minCoeff(); }
  double high() const { return rest.vertices.col(2).maxCoeff(); }
};

/// @param x, z axes of the solver in the body's frame; unit, normal to each other.
PressedBody pressedBody(const Stage& stage, const Eigen::Vector3d& x = Eigen::Vector3d::UnitX(),
                        const Eigen::Vector3d& z = Eigen::Vector3d::UnitZ());

/// The thing that presses. Its frame is that of its flat side; z points away from the body.
struct PressingThing {
  std::string name;  ///< of its frame
  TriangleMesh mesh;
  Texture paint;
  PressedSolid::Stamp stamp;  ///< its flat side
  /// Largest force [N]. @param height_m of the flat side over the body's lowest point.
  std::function<double(double height_m)> largest_n = {};
  std::function<double(double t)> root = {};  ///< of the share of the largest force
  std::function<double(double t)> away_m = [](double) {
    return 0.0;
  };  ///< from where it would touch the body
};

/// A play of a body that lies on a table, or is held. @param T_body_frame of holders: in the body's frame.
struct Pressing {
  Play play;
  std::shared_ptr<const PressedStates> states;
};
Pressing pressing(const Stage& stage, const std::shared_ptr<const PressedBody>& body,
                  const PressingThing& thing, std::vector<Holder> holders = {});

}  // namespace softbody::virtual_camera
