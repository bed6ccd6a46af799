#pragma once

#include <Eigen/SparseCore>
#include <memory>
#include <vector>

#include "constraints/target_energy.h"
#include "fem/fem_elasticity.h"
#include "forces/sparse_forces.h"
#include "forces/surface_places.h"
#include "softbody_sim/elasticity/elasticity.h"
#include "softbody_sim/forces/force_estimate.h"
#include "tets/block_tet_matrix.h"

namespace softbody {

/// What acts on a body besides the forces to be found, and what is seen of it.
struct ObservedBalance {
  const Points& vertices;        ///< #V by 3 [m]; only the start of a linear model
  const TargetEnergy& measured;  ///< with inverse variances in place of stiffnesses [1/m^2]
  const TargetEnergy& contacts;
  const std::vector<Pin>& pins;
  const std::vector<double>& pin_stiffness;  ///< of each pin [N/m]
  const Points& loads;                       ///< gravity and known loads, #V by 3 [N]
};

/// Estimates the external forces on a body in balance. Around the present shape x, a shape x + d is in
/// balance with the forces f on places P of its surface if
///
///   (K + H + M / T^2) d = P f + loads - elastic, pin and contact forces at x
///
/// with the elastic Hessian K, the stiffness H of pins and contacts, and the masses M over a long time T,
/// which let a piece that nothing holds move as a whole. The measurements say which d, and so which f, are
/// probable: a linear model with normal noise. sparseForces() gives the fewest forces.
class ForceEstimator {
 public:
  /// @param scale_n size of a large force on a place [N].
  ForceEstimator(const TetTopology& topology, Elasticity elasticity, const ElasticMaterials& materials,
                 const Eigen::VectorXd& masses, double scale_n);
  ~ForceEstimator();

  /// In the targets' frame. @throw std::runtime_error if the linear system cannot be solved.
  ForceEstimate estimate(const ObservedBalance& balance);

 private:
  struct Factor;
  /// Around a shape.
  struct LinearBody {
    /// #V by 3 [m]. @param forces three a place.
    Points moveUnder(const Eigen::VectorXd& forces) const;

    Eigen::VectorXd still;       ///< d without forces
    Eigen::MatrixXd compliance;  ///< d by unit forces
    ForceEvidence evidence;
  };

  Points linearize(const ObservedBalance& balance, const Points& x);
  Eigen::MatrixXd forcesOnPlaces(const std::vector<Pin>& pins) const;
  ForceEvidence evidence(const ObservedBalance& balance, const Points& x, const Eigen::VectorXd& still,
                         const Eigen::MatrixXd& compliance);

  LinearBody linearBody(const ObservedBalance& balance, const Points& x);

  const FemElasticity elasticity_;
  const Eigen::VectorXd slow_masses_;  ///< M / T^2 [N/m]
  const double scale_n_;
  const SurfacePlaces places_;
  BlockTetMatrix stiffness_, information_;
  std::unique_ptr<Factor> factor_;
};

}  // namespace softbody
