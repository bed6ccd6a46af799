#pragma once

#include <Eigen/SparseCholesky>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_sim/object/material.h"

namespace softbody::bench {

/// Reference for compare_peers: springs on the edges of the tets (stiffness of Van Gelder 1998), implicit
/// Euler, solved by local and global steps with one prefactored matrix (Liu et al. 2013).
class MassSprings {
 public:
  /// @param targets of the first step; later steps have the same places. @param stiffness of a target [N/m].
  MassSprings(const TetTopology& topology, const Material& material, const std::vector<Target>& targets,
              double stiffness, double step_s);

  /// Sets the vertices, without velocity.
  void place(const Points& x);
  void step(const std::vector<Target>& targets, int iterations);
  const Points& vertices() const { return x_; }

 private:
  struct Spring {
    int a, b;
    double length, stiffness;
  };
  void addTarget(const Target& target, std::vector<Eigen::Triplet<double>>* entries) const;
  Points rightSide(const std::vector<Target>& targets, const Points& prediction) const;

  const Tets tets_;
  const double damping_, target_stiffness_, step_s_;
  std::vector<Spring> springs_;
  Eigen::VectorXd inertia_;  ///< mass over squared step [kg/s^2]
  Points x_, velocity_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> solver_;
};

}  // namespace softbody::bench
