#include "solid/held_solid.h"

namespace softbody::virtual_camera {
namespace {

class HeldSolid : public Objective {
 public:
  HeldSolid(const HexSolid& solid, const Eigen::VectorXd& loads) : solid_(solid), loads_(loads) {}

  double value(const Eigen::VectorXd& nodes) const override {
    return solid_.energy(nodes) - (loads_.size() == 0 ? 0.0 : loads_.dot(nodes));
  }
  Eigen::VectorXd gradient(const Eigen::VectorXd& nodes) const override {
    Eigen::VectorXd forces = holdingForces(solid_, nodes);
    if (loads_.size() != 0) forces -= loads_;
    return forces;
  }
  Triplets curvature(const Eigen::VectorXd& nodes, bool positive) const override {
    Triplets triplets;
    solid_.addStiffness(nodes, positive, &triplets);
    return triplets;
  }

 private:
  const HexSolid& solid_;
  const Eigen::VectorXd& loads_;
};

}  // namespace

Eigen::VectorXd heldShape(const HexSolid& solid, const Eigen::VectorXd& start, const std::vector<bool>& held,
                          const Eigen::VectorXd& loads) {
  std::vector<bool> fixed;
  for (const bool is_held : held) fixed.insert(fixed.end(), 3, is_held);
  return minimized(HeldSolid(solid, loads), start, fixed, kBalance_n);
}

Eigen::VectorXd holdingForces(const HexSolid& solid, const Eigen::VectorXd& nodes) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodes.size());
  solid.addGradient(nodes, &forces);
  return forces;
}

}  // namespace softbody::virtual_camera
