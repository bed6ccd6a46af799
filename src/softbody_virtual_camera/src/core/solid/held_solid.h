#pragma once

#include "solid/newton.h"

namespace softbody::virtual_camera {

/// The shape in balance of a body with some nodes held.
/// @param start of all nodes; the held ones stay there. @param held for each node. @param loads on the nodes
/// [N], three numbers each; empty: the weight is part of the rest shape.
/// @throw std::runtime_error if no balance is found.
Eigen::VectorXd heldShape(const HexSolid& solid, const Eigen::VectorXd& start, const std::vector<bool>& held,
                          const Eigen::VectorXd& loads = {});

/// The forces on all nodes that hold the body in this shape [N], three numbers each; loads are part of them.
Eigen::VectorXd holdingForces(const HexSolid& solid, const Eigen::VectorXd& nodes);

}  // namespace softbody::virtual_camera
