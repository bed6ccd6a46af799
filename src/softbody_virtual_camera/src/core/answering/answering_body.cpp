#include "answering/answering_body.h"

#include <Eigen/Dense>

#include "softbody_common/tet_geometry.h"

namespace softbody::virtual_camera {
namespace {

const Eigen::Vector3d kCell_m(0.0143, 0.0143, 0.0134);  // edges of a cell, at most

/// Each cell as six tets around its diagonal (Kuhn 1960), so that neighbours fit.
TetTopology tetsOf(const CellGrid& grid) {
  constexpr int kWays[6][4] = {{0, 4, 6, 7}, {0, 4, 5, 7}, {0, 2, 6, 7},
                               {0, 2, 3, 7}, {0, 1, 5, 7}, {0, 1, 3, 7}};
  TetTopology topology;
  topology.rest_vertices = grid.nodes;
  topology.tets.resize(static_cast<Eigen::Index>(6 * grid.cells.size()), 4);
  Eigen::Index row = 0;
  for (const std::array<int, 8>& cell : grid.cells)
    for (const auto& way : kWays) {
      for (int k = 0; k < 4; ++k) topology.tets(row, k) = cell[static_cast<std::size_t>(way[k])];
      ++row;
    }
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t)
    if (volumes[t] < 0.0) std::swap(topology.tets(t, 2), topology.tets(t, 3));
  topology.surface = boundaryTriangles(topology.tets);
  topology.vertex_parents.resize(static_cast<std::size_t>(grid.nodes.rows()));
  for (std::size_t i = 0; i < topology.vertex_parents.size(); ++i)
    topology.vertex_parents[i] = static_cast<int>(i);
  topology.tet_pieces.assign(static_cast<std::size_t>(topology.tets.rows()), 0);
  return topology;
}

Material simulated(const TrueMaterial& material) {
  const Elasticity& e = material.elasticity;
  return {e.youngs_modulus_pa, e.poisson_ratio, *e.density_kg_m3, e.damping};
}

SimulatorConfig configOf(double gravity_m_s2) {
  SimulatorConfig config;
  config.solver = SolverKind::kFem;
  config.gravity = {0.0, 0.0, -gravity_m_s2};
  config.load_fade_s = config.memory_s = 0.0;  // there are no measurements
  return config;
}

}  // namespace

AnsweringBody::AnsweringBody(const TriangleMesh& rest, const Elasticity& elasticity,
                             const Eigen::Isometry3d& T_world_body, double gravity_m_s2,
                             const HandShape& hand)
    : body_(rest, elasticity, kCell_m),
      T_world_body_(T_world_body),
      hand_(hand),
      simulator_(tetsOf(body_.solid().grid()), simulated(body_.material()), configOf(gravity_m_s2)) {
  TargetSet start;
  start.reset = true;
  start.body_pose = T_world_body;
  simulator_.step(start, stamp_);
}

void AnsweringBody::grip(const Eigen::Isometry3d& T_world_hand) {
  const Eigen::Isometry3d T_hand_world = T_world_hand.inverse();
  const Points& nodes = simulator_.state().vertices;
  for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
    const Eigen::Vector3d in_hand = T_hand_world * nodes.row(i).transpose();
    if (((hand_.half_inside - in_hand.cwiseAbs()).array() >= 0.0).all())
      held_.push_back({static_cast<int>(i), in_hand});
  }
}

Surroundings AnsweringBody::surroundings(const HandContact& hand) const {
  Surroundings surroundings;
  surroundings.obstacles.push_back(Obstacle::plane());
  for (const Eigen::Isometry3d& T_world_finger : hand.T_world_fingers) {
    surroundings.obstacles.push_back(Obstacle::box(hand_.finger, 0.1 * hand_.finger.minCoeff()));
    surroundings.obstacles.back().pose = T_world_finger;
  }
  for (Obstacle& obstacle : surroundings.obstacles) obstacle.friction = kAnswerFriction;
  for (const Held& held : held_) surroundings.pins.push_back({held.node, hand.T_world_hand * held.in_hand});
  return surroundings;
}

void AnsweringBody::step(const HandContact& hand) {
  if (hand.closed && !closed_) grip(hand.T_world_hand);
  if (!hand.closed) held_.clear();
  closed_ = hand.closed;
  stamp_ += static_cast<Nanoseconds>(1e9 * kAnswerStep_s);
  simulator_.step(TargetSet(), stamp_, surroundings(hand));
}

Points AnsweringBody::surface() const {
  const Points nodes = transformed(T_world_body_.inverse(), simulator_.state().vertices);
  return transformed(T_world_body_, body_.surface(nodes - body_.restNodes()));
}

Wrench AnsweringBody::onTable() const {
  const std::vector<Wrench>& obstacles = simulator_.reactions().obstacles;
  return obstacles.empty() ? Wrench() : obstacles.front();
}

}  // namespace softbody::virtual_camera
