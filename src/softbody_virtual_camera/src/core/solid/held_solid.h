#pragma once

#include "solid/newton.h"

namespace softbody::virtual_camera {

/// The shape in balance of a body whose weight is part of its rest shape, with some nodes held.
/// @param start of all nodes; the held ones stay there. @param held for each node.
/// @throw std::runtime_error if no balance is found.
Eigen::VectorXd heldShape(const HexSolid& solid, const Eigen::VectorXd& start, const std::vector<bool>& held);

/// The forces of all nodes on the body that hold it in this shape [N], three numbers each.
Eigen::VectorXd holdingForces(const HexSolid& solid, const Eigen::VectorXd& nodes);

}  // namespace softbody::virtual_camera
