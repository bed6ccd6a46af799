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

/// A user's object YAML (docs/your_own_object.md), with absolute paths.
struct ObjectDescription {
  std::string visual_mesh;
  std::string cage_mesh;  ///< empty: made from visual_mesh and cached
  std::string tet_mesh;   ///< empty: made from the cage and cached
  double unit_m = 1.0;    ///< metres per file unit
  double thickness_m =
      0.0;  ///< not in the YAML: visual_mesh is a sheet of this thickness; 0: it encloses the body
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
