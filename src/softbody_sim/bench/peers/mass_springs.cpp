#include "bench/peers/mass_springs.h"

#include <algorithm>
#include <map>
#include <utility>

#include "softbody_common/geometry/tet_geometry.h"

namespace softbody::bench {

MassSprings::MassSprings(const TetTopology& topology, const Material& material,
                         const std::vector<Target>& targets, double stiffness, double step_s)
    : tets_(topology.tets),
      damping_(material.damping),
      target_stiffness_(stiffness),
      step_s_(step_s),
      inertia_(Eigen::VectorXd::Zero(topology.rest_vertices.rows())) {
  const Points& rest = topology.rest_vertices;
  const Eigen::VectorXd volumes = tetVolumes(rest, tets_);
  std::map<std::pair<int, int>, double> edges;  // volume of the tets around an edge [m^3]
  for (Eigen::Index t = 0; t < tets_.rows(); ++t) {
    for (int a = 0; a < 4; ++a) {
      inertia_[tets_(t, a)] += 0.25 * material.density_kg_m3 * volumes[t] / (step_s * step_s);
      for (int b = 0; b < a; ++b) edges[std::minmax(tets_(t, a), tets_(t, b))] += volumes[t];
    }
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) entries.emplace_back(v, v, inertia_[v]);
  for (const auto& [ends, volume] : edges) {
    const auto [a, b] = ends;
    const double length = (rest.row(a) - rest.row(b)).norm();
    springs_.push_back({a, b, length, material.youngs_modulus_pa * volume / (length * length)});
    const double k = springs_.back().stiffness;
    entries.insert(entries.end(), {{a, a, k}, {b, b, k}, {a, b, -k}, {b, a, -k}});
  }
  for (const Target& target : targets) addTarget(target, &entries);
  Eigen::SparseMatrix<double> A(rest.rows(), rest.rows());
  A.setFromTriplets(entries.begin(), entries.end());
  solver_.compute(A);
}

void MassSprings::addTarget(const Target& target, std::vector<Eigen::Triplet<double>>* entries) const {
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) {
      entries->emplace_back(tets_(target.place.tet, a), tets_(target.place.tet, b),
                            target_stiffness_ * target.place.barycentric[a] * target.place.barycentric[b]);
    }
  }
}

void MassSprings::place(const Points& x) {
  x_ = x;
  velocity_ = Points::Zero(x.rows(), 3);
}

Points MassSprings::rightSide(const std::vector<Target>& targets, const Points& prediction) const {
  Points b = inertia_.asDiagonal() * prediction;
  for (const Target& target : targets) {
    for (int k = 0; k < 4; ++k) {
      b.row(tets_(target.place.tet, k)) +=
          target_stiffness_ * target.place.barycentric[k] * target.position.transpose();
    }
  }
  return b;
}

void MassSprings::step(const std::vector<Target>& targets, int iterations) {
  const Points before = x_;
  const Points fixed = rightSide(targets, x_ + step_s_ * (1.0 - damping_) * velocity_);
  for (int i = 0; i < iterations; ++i) {
    Points b = fixed;
    for (const Spring& spring : springs_) {
      const Eigen::RowVector3d along = (x_.row(spring.a) - x_.row(spring.b)).normalized();
      const Eigen::RowVector3d pull = spring.stiffness * spring.length * along;
      b.row(spring.a) += pull;
      b.row(spring.b) -= pull;
    }
    x_ = solver_.solve(b);
  }
  velocity_ = (x_ - before) / step_s_;
}

}  // namespace softbody::bench
