#pragma once

#include <optional>

#include "solid/newton.h"

namespace softbody::virtual_camera {

/// A small part of the body's surface.
struct SurfaceSample {
  Embedding place;
  double area_m2 = 0.0;
  bool faces_up = false;
};
/// @param body at rest. @param spacing_m of the samples, at most.
std::vector<SurfaceSample> samplesOf(const TriangleMesh& body, const CellGrid& grid, double spacing_m);

/// What presses on a part of the surface.
struct ContactForce {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< on the body [N]
  Eigen::Vector3d place = Eigen::Vector3d::Zero();   ///< mean, weighted by the sizes of the forces [m]
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< on the body, about the origin [N m]
};

struct PressedShape {
  Eigen::VectorXd nodes;
  double stamp_m = 0.0;  ///< height of the stamp's flat side
  ContactForce stamp, table;
};

/// A body that lies on a table, or is held, and is pressed by a flat, round stamp. Both are rigid planes with
/// a penalty: under a pressure of a tenth of Young's modulus the body sinks in by 0.01 mm. The weight is part
/// of the rest shape. What touches a plane sticks to it.
class PressedSolid : public Objective {
 public:
  struct Stamp {
    Eigen::Vector2d center;
    double radius_m = 0.0;
  };

  /// @param body at rest; the table is under its lowest point. @param held for each node; if given, these
  /// nodes stay where they are, and there is no table.
  PressedSolid(const HexSolid& solid, const TriangleMesh& body, const Stamp& stamp, double youngs_modulus_pa,
               const std::vector<bool>& held = {});

  /// The next shape in balance, from the last one on. @param force_n of the stamp, downwards; above 0.
  /// @throw std::runtime_error if no balance is found.
  PressedShape press(double force_n);

  const PressedShape& shape() const { return shape_; }

  double value(const Eigen::VectorXd& unknowns) const override;
  Eigen::VectorXd gradient(const Eigen::VectorXd& unknowns) const override;
  Triplets curvature(const Eigen::VectorXd& unknowns, bool positive) const override;

 private:
  struct Contact {
    SurfaceSample sample;
    bool on_stamp = false;
    std::optional<Eigen::Vector2d> sticks;  ///< where it touched the plane
  };

  Eigen::Vector3d placeOf(const Contact& contact, const Eigen::VectorXd& unknowns) const;
  /// How far a sample is in its plane, upwards from the table or downwards from the stamp; negative: apart.
  double depthOf(const Contact& contact, const Eigen::VectorXd& unknowns) const;
  Eigen::Vector3d forceOn(const Contact& contact, const Eigen::VectorXd& unknowns) const;
  void updateSticking(const Eigen::VectorXd& unknowns);
  ContactForce sumOf(bool on_stamp, const Eigen::VectorXd& unknowns) const;

  const HexSolid& solid_;
  const double plane_stiffness_;  ///< [Pa/m]
  double table_m_ = 0.0, force_n_ = 0.0;
  std::vector<bool> fixed_;  ///< per unknown
  std::vector<Contact> contacts_;
  PressedShape shape_;
};

}  // namespace softbody::virtual_camera
