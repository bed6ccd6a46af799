#include "forces/force_patches.h"

#include <Eigen/Dense>
#include <algorithm>
#include <utility>
#include <vector>

#include "softbody_common/geometry/rigid_motion.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

using Matrix6 = ForceEstimate::Matrix6;

/// Numbers of forces whose places are equal or touch.
std::vector<std::vector<int>> groupsOf(const SparseForces& forces, const SurfacePlaces& places) {
  const auto touch = [&](int a, int b) {
    return std::find(places.touching.begin(), places.touching.end(),
                     std::pair<int, int>(std::minmax(a, b))) != places.touching.end();
  };
  std::vector<std::vector<int>> groups;
  for (std::size_t k = 0; k < forces.places.size(); ++k) {
    std::vector<int> joined{static_cast<int>(k)};
    const auto meets = [&](const std::vector<int>& group) {
      return std::any_of(group.begin(), group.end(), [&](int other) {
        return touch(forces.places[k], forces.places[static_cast<std::size_t>(other)]);
      });
    };
    for (std::vector<int>& group : groups) {
      if (!meets(group)) continue;
      joined.insert(joined.end(), group.begin(), group.end());
      group.clear();
    }
    groups.push_back(joined);
    groups.erase(std::remove_if(groups.begin(), groups.end(), [](const auto& g) { return g.empty(); }),
                 groups.end());
  }
  return groups;
}

/// Where a force acts.
struct PlaceOfForce {
  Eigen::Vector3d position, normal;
  Eigen::Matrix3d covariance;  ///< of the position [m^2]
};

/// Position and normal of each place, one a row.
struct PlacesInSpace {
  Points positions, normals;
};

PlacesInSpace inSpace(const SurfacePlaces& places, const Points& vertices) {
  const auto count = static_cast<Eigen::Index>(places.count());
  const Points normals = vertexNormals(vertices, places.triangles);
  PlacesInSpace result{Points::Zero(count, 3), Points::Zero(count, 3)};
  for (Eigen::Index place = 0; place < count; ++place) {
    for (int v : places.vertices[static_cast<std::size_t>(place)]) {
      result.positions.row(place) += places.shares[static_cast<std::size_t>(v)] * vertices.row(v);
      result.normals.row(place) += places.shares[static_cast<std::size_t>(v)] * normals.row(v);
    }
  }
  return result;
}

PlaceOfForce placeOf(const Eigen::VectorXd& where, const PlacesInSpace& places) {
  const Eigen::Vector3d mean = places.positions.transpose() * where;
  const Points offsets = places.positions.rowwise() - mean.transpose();
  return {mean, places.normals.transpose() * where, offsets.transpose() * where.asDiagonal() * offsets};
}

ForcePatch patchOf(const SparseForces& forces, const std::vector<int>& group,
                   const std::vector<PlaceOfForce>& places) {
  ForcePatch patch;
  patch.normal.setZero();
  double sum = 0.0;
  for (int a : group) {
    const Eigen::Vector3d force = forces.mean.segment<3>(3 * a);
    const double size = force.norm();
    patch.force += force;
    patch.place += size * places[static_cast<std::size_t>(a)].position;
    patch.normal += size * places[static_cast<std::size_t>(a)].normal;
    sum += size;
    for (int b : group) patch.covariance += forces.covariance.block<3, 3>(3 * a, 3 * b);
  }
  patch.place /= sum;
  patch.normal.normalize();
  return patch;
}

}  // namespace

ForceEstimate patchesOf(const SparseForces& forces, const SurfacePlaces& places, const Points& vertices) {
  const PlacesInSpace in_space = inSpace(places, vertices);
  std::vector<PlaceOfForce> at;
  for (const Eigen::VectorXd& where : forces.where) at.push_back(placeOf(where, in_space));
  ForceEstimate estimate;
  for (const std::vector<int>& group : groupsOf(forces, places))
    estimate.patches.push_back(patchOf(forces, group, at));
  std::sort(estimate.patches.begin(), estimate.patches.end(),
            [](const ForcePatch& a, const ForcePatch& b) { return a.force.norm() > b.force.norm(); });
  Eigen::MatrixXd sum(6, forces.mean.size());
  for (std::size_t k = 0; k < at.size(); ++k) {
    const auto column = 3 * static_cast<Eigen::Index>(k);
    sum.block<3, 3>(0, column).setIdentity();
    sum.block<3, 3>(3, column) = crossMatrix(at[k].position);
    const Eigen::Matrix3d lever = crossMatrix(forces.mean.segment<3>(column));
    estimate.wrench_covariance.bottomRightCorner<3, 3>() += lever * at[k].covariance * lever.transpose();
  }
  estimate.wrench = sum * forces.mean;
  estimate.wrench_covariance += sum * forces.covariance * sum.transpose();
  return estimate;
}

ForceEstimate withWrenchIn(ForceEstimate estimate, const Eigen::Isometry3d& pose) {
  const Eigen::Matrix3d to = pose.linear().transpose();
  Matrix6 move = Matrix6::Zero();
  move.topLeftCorner<3, 3>() = move.bottomRightCorner<3, 3>() = to;
  move.bottomLeftCorner<3, 3>() = -to * crossMatrix(pose.translation());
  estimate.wrench = (move * estimate.wrench).eval();
  estimate.wrench_covariance = (move * estimate.wrench_covariance * move.transpose()).eval();
  return estimate;
}

ForceEstimate inKnownUnit(ForceEstimate estimate, const Material& material) {
  const double modulus = material.youngs_modulus_pa;
  estimate.in_newtons = material.youngs_modulus_std_pa.has_value();
  const double factor = estimate.in_newtons ? 1.0 : 1.0 / modulus,
               relative = material.youngs_modulus_std_pa.value_or(0.0) / modulus,
               variance = relative * relative;
  for (ForcePatch& patch : estimate.patches) {
    patch.force *= factor;
    patch.covariance *= factor * factor;
    patch.covariance += variance * patch.force * patch.force.transpose();
  }
  estimate.wrench *= factor;
  estimate.wrench_covariance *= factor * factor;
  estimate.wrench_covariance += variance * estimate.wrench * estimate.wrench.transpose();
  return estimate;
}

}  // namespace softbody
