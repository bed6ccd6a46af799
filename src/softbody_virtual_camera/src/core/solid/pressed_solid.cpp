#include "solid/pressed_solid.h"

#include <Eigen/Dense>
#include <algorithm>

namespace softbody::virtual_camera {
namespace {

constexpr double kPlaneStiffness = 1e4;  // over Young's modulus [1/m]
constexpr double kFirstDepth = 0.2e-3;   // so that both planes hold the body from the first step on [m]
constexpr double kSpacing = 3e-3;        // of samples [m]
constexpr int kPasses = 2;               // of a step, so that what leaves a plane does not stick to it

void addSamples(const Eigen::Matrix3d& corners, const CellGrid& grid, double spacing_m,
                std::vector<SurfaceSample>* samples) {
  Eigen::Index longest = 0;
  const Eigen::Vector3d edges((corners.row(1) - corners.row(2)).norm(),
                              (corners.row(2) - corners.row(0)).norm(),
                              (corners.row(0) - corners.row(1)).norm());
  if (edges.maxCoeff(&longest) > spacing_m) {
    const Eigen::Index a = (longest + 1) % 3, b = (longest + 2) % 3;
    Eigen::Matrix3d first = corners, second = corners;
    first.row(b) = second.row(a) = 0.5 * (corners.row(a) + corners.row(b));
    addSamples(first, grid, spacing_m, samples);
    addSamples(second, grid, spacing_m, samples);
    return;
  }
  const Eigen::Vector3d normal = (corners.row(1) - corners.row(0)).cross(corners.row(2) - corners.row(0));
  samples->push_back(
      {grid.embed(corners.colwise().mean().transpose()), 0.5 * normal.norm(), normal.z() > 0.0});
}

}  // namespace

std::vector<SurfaceSample> samplesOf(const TriangleMesh& body, const CellGrid& grid, double spacing_m) {
  std::vector<SurfaceSample> samples;
  for (Eigen::Index f = 0; f < body.triangles.rows(); ++f)
    addSamples(body.vertices(body.triangles.row(f).transpose(), Eigen::all), grid, spacing_m, &samples);
  return samples;
}

PressedSolid::PressedSolid(const HexSolid& solid, const TriangleMesh& body, const Stamp& stamp,
                           double youngs_modulus_pa, const std::vector<bool>& held)
    : solid_(solid),
      plane_stiffness_(kPlaneStiffness * youngs_modulus_pa),
      table_m_(body.vertices.col(2).minCoeff()) {
  constexpr double kNearTable = 0.015;  // what may come down to it [m]
  double top = table_m_;
  for (const SurfaceSample& sample : samplesOf(body, solid.grid(), kSpacing)) {
    const Eigen::Vector3d rest = sample.place.in(solid.grid().nodes);
    const bool under_stamp = sample.faces_up && (rest.head<2>() - stamp.center).norm() <= stamp.radius_m;
    if (under_stamp) top = std::max(top, rest.z());
    if (under_stamp || (held.empty() && !sample.faces_up && rest.z() < table_m_ + kNearTable))
      contacts_.push_back({sample, under_stamp, {}});
  }
  shape_.nodes = solid.rest();
  shape_.stamp_m = top;
  fixed_.assign(static_cast<std::size_t>(solid.unknowns()) + 1, false);
  for (std::size_t i = 0; i < held.size(); ++i)
    std::fill_n(fixed_.begin() + static_cast<std::ptrdiff_t>(3 * i), 3, held[i]);
}

Eigen::Vector3d PressedSolid::placeOf(const Contact& contact, const Eigen::VectorXd& unknowns) const {
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (std::size_t k = 0; k < 8; ++k)
    place += contact.sample.place.weights[k] * unknowns.segment<3>(3 * contact.sample.place.nodes[k]);
  return place;
}

double PressedSolid::depthOf(const Contact& contact, const Eigen::VectorXd& unknowns) const {
  const double height = placeOf(contact, unknowns).z();
  return contact.on_stamp ? height - unknowns[unknowns.size() - 1] : table_m_ - height;
}

Eigen::Vector3d PressedSolid::forceOn(const Contact& contact, const Eigen::VectorXd& unknowns) const {
  const double stiffness = plane_stiffness_ * contact.sample.area_m2;
  const double depth = std::max(0.0, depthOf(contact, unknowns));
  Eigen::Vector3d force(0.0, 0.0, (contact.on_stamp ? -1.0 : 1.0) * stiffness * depth);
  if (contact.sticks) force.head<2>() = stiffness * (*contact.sticks - placeOf(contact, unknowns).head<2>());
  return force;
}

double PressedSolid::value(const Eigen::VectorXd& unknowns) const {
  double sum = solid_.energy(unknowns) + force_n_ * unknowns[unknowns.size() - 1];
  for (const Contact& contact : contacts_)
    sum += 0.5 * forceOn(contact, unknowns).squaredNorm() / (plane_stiffness_ * contact.sample.area_m2);
  return sum;
}

Eigen::VectorXd PressedSolid::gradient(const Eigen::VectorXd& unknowns) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(unknowns.size());
  solid_.addGradient(unknowns, &sum);
  double& stamp = sum[unknowns.size() - 1];
  stamp += force_n_;
  for (const Contact& contact : contacts_) {
    const Eigen::Vector3d force = forceOn(contact, unknowns);
    if (contact.on_stamp) stamp += force.z();
    for (std::size_t k = 0; k < 8; ++k)
      sum.segment<3>(3 * contact.sample.place.nodes[k]) -= contact.sample.place.weights[k] * force;
  }
  return sum;
}

Triplets PressedSolid::curvature(const Eigen::VectorXd& unknowns, bool positive) const {
  Triplets triplets;
  solid_.addStiffness(unknowns, positive, &triplets);
  const int stamp = static_cast<int>(unknowns.size()) - 1;
  triplets.emplace_back(stamp, stamp, 0.0);
  for (const Contact& contact : contacts_) {
    const double stiffness = plane_stiffness_ * contact.sample.area_m2;
    const auto& [nodes, weights] = contact.sample.place;
    const bool touches = depthOf(contact, unknowns) > 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(axis == 2 ? touches : contact.sticks.has_value())) continue;
      for (std::size_t k = 0; k < 8; ++k) {
        const int row = 3 * nodes[k] + axis;
        for (std::size_t l = 0; l < 8; ++l) {
          const int column = 3 * nodes[l] + axis;
          if (row >= column) triplets.emplace_back(row, column, stiffness * weights[k] * weights[l]);
        }
        if (axis == 2 && contact.on_stamp) triplets.emplace_back(stamp, row, -stiffness * weights[k]);
      }
    }
    if (touches && contact.on_stamp) triplets.emplace_back(stamp, stamp, stiffness);
  }
  return triplets;
}

void PressedSolid::updateSticking(const Eigen::VectorXd& unknowns) {
  for (Contact& contact : contacts_) {
    const double depth = depthOf(contact, unknowns);
    if (depth <= 0.0) contact.sticks.reset();
    if (depth > 0.0 && !contact.sticks) contact.sticks = placeOf(contact, unknowns).head<2>();
  }
}

ContactForce PressedSolid::sumOf(bool on_stamp, const Eigen::VectorXd& unknowns) const {
  ContactForce sum;
  double sizes = 0.0;
  for (const Contact& contact : contacts_) {
    if (contact.on_stamp != on_stamp) continue;
    const Eigen::Vector3d force = forceOn(contact, unknowns);
    sum.force += force;
    sum.place += force.norm() * placeOf(contact, unknowns);
    sum.torque += placeOf(contact, unknowns).cross(force);
    sizes += force.norm();
  }
  sum.place /= std::max(sizes, 1e-12);
  return sum;
}

PressedShape PressedSolid::press(double force_n) {
  const bool first = force_n_ == 0.0;
  force_n_ = force_n;
  Eigen::VectorXd unknowns(shape_.nodes.size() + 1);
  unknowns << shape_.nodes, shape_.stamp_m;
  if (first) {
    for (Eigen::Index z = 2; z < shape_.nodes.size(); z += 3)
      if (!fixed_[static_cast<std::size_t>(z)]) unknowns[z] -= kFirstDepth;
    unknowns[shape_.nodes.size()] -= 2.0 * kFirstDepth;
  }
  for (int pass = 0; pass < kPasses; ++pass) {
    updateSticking(unknowns);
    unknowns = minimized(*this, unknowns, fixed_, kBalance_n);
  }
  shape_ = {unknowns.head(shape_.nodes.size()), unknowns[unknowns.size() - 1], sumOf(true, unknowns),
            sumOf(false, unknowns)};
  return shape_;
}

}  // namespace softbody::virtual_camera
