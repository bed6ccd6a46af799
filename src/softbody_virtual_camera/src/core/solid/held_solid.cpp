#include "solid/held_solid.h"

namespace softbody::virtual_camera {
namespace {

class HeldSolid : public Objective {
 public:
  explicit HeldSolid(const HexSolid& solid) : solid_(solid) {}

  double value(const Eigen::VectorXd& nodes) const override { return solid_.energy(nodes); }
  Eigen::VectorXd gradient(const Eigen::VectorXd& nodes) const override {
    return holdingForces(solid_, nodes);
  }
  Triplets curvature(const Eigen::VectorXd& nodes, bool positive) const override {
    Triplets triplets;
    solid_.addStiffness(nodes, positive, &triplets);
    return triplets;
  }

 private:
  const HexSolid& solid_;
};

}  // namespace

Eigen::VectorXd heldShape(const HexSolid& solid, const Eigen::VectorXd& start,
                          const std::vector<bool>& held) {
  std::vector<bool> fixed;
  for (const bool is_held : held) fixed.insert(fixed.end(), 3, is_held);
  return minimized(HeldSolid(solid), start, fixed, kBalance_n);
}

Eigen::VectorXd holdingForces(const HexSolid& solid, const Eigen::VectorXd& nodes) {
  Eigen::VectorXd forces = Eigen::VectorXd::Zero(nodes.size());
  solid.addGradient(nodes, &forces);
  return forces;
}

}  // namespace softbody::virtual_camera
