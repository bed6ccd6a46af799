#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/files/input_file.h"
#include "softbody_sim/io/warnings.h"
#include "softbody_sim/object/material.h"
#include "softbody_sim/object/pin_region.h"

namespace softbody {

/// How prepare_model makes a body of the visual mesh; not in the YAML.
struct BodyOptions {
  double thickness = 0.0;  ///< of a sheet, in file units; 0: the mesh encloses the body
  double length_m = 0.0;   ///< of the body's longest side; above 0, it replaces the unit
  std::string shell;       ///< "all", "largest" or a number from 1; empty: the largest if it dominates
  int triangles = 0;       ///< simplify to about this number; 0: keep all
};

/// A user's object YAML (docs/your_own_object.md), with absolute paths.
struct ObjectDescription {
  std::string visual_mesh;
  std::string cage_mesh;  ///< empty: made from visual_mesh and cached
  std::string tet_mesh;   ///< empty: made from the cage and cached
  double unit_m = 1.0;    ///< metres per file unit
  BodyOptions body;
  Material material;
  std::optional<Eigen::Isometry3d> initial_pose;  ///< rest frame in the colour optical frame, rough
  std::vector<PinRegion> pins;                    ///< held from the start
  Warnings warnings;                              ///< unknown keys
};

/// Metres per m, cm, mm or inch. @throw std::invalid_argument for any other unit.
double metresPer(const std::string& unit);

/// Reads and checks an object YAML. @param given the file, or the folder of its object.yaml. @param scope
/// where the meshes may be.
/// @throw std::invalid_argument with file, key, value and allowed values.
ObjectDescription loadObjectDescription(const std::string& given, FileScope scope = FileScope::kOwnFolder);

}  // namespace softbody
