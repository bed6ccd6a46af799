#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/types.h"
#include "softbody_sim/io/mesh_files.h"

namespace softbody {

struct Material {
  double youngs_modulus_pa = 2.0e4;
  double poisson_ratio = 0.2;  ///< below 0.5
  double density_kg_m3 = 30.0;
  double damping = 0.1;  ///< fraction of the velocity lost per 1/30 s, 0..1
};

/// Vertices that are held, by a box around their rest positions.
struct PinRegion {
  std::string name;   ///< of its reaction's topic
  std::string frame;  ///< that they follow; empty: they stay where they are
  Eigen::Vector3d min = Eigen::Vector3d::Zero(), max = Eigen::Vector3d::Zero();  ///< [m]
};

/// What a user's object YAML says (ARCHITECTURE: "Files that a user writes"), paths made absolute.
struct ObjectDescription {
  std::string visual_mesh;
  std::string cage_mesh;  ///< empty: made from visual_mesh and cached
  std::string tet_mesh;   ///< empty: made from the cage and cached
  double unit_m = 1.0;    ///< metres per file unit
  Material material;
  std::optional<Eigen::Isometry3d> initial_pose;  ///< rest frame in the colour optical frame, rough
  std::vector<PinRegion> pins;                    ///< held from the start
  Warnings warnings;                              ///< unknown keys
};

/// How a volume is made where none is given.
struct VolumeSettings {
  int cage_vertices = 0;  ///< about as many vertices has the low-resolution surface; 0: as suits its shape
  bool use_cache = true;  ///< $XDG_CACHE_HOME/softbody or ~/.cache/softbody, by content
  std::function<void(double)> progress = [](double) {};  ///< told the share that is done (0..1)
};

/// Everything the graph needs of one object.
struct ObjectModel {
  MeshTopology visual;  ///< revision 0
  TetTopology volume;   ///< revision 0, its surface is the low-resolution surface
  Material material;
  Warnings warnings;  ///< the description's too: what was repaired, what does not enclose what
};

/// Metres per m, cm, mm or inch. @throw std::invalid_argument for anything else.
double metresPer(const std::string& unit);

/// Reads and checks an object YAML. @throw std::invalid_argument with file, key, value and what is allowed.
ObjectDescription loadObjectDescription(const std::string& yaml_path);

/// Loads and repairs the visual mesh only: all that the surface node needs.
/// @throw std::invalid_argument with file and place.
MeshTopology loadVisualMesh(const ObjectDescription& description, Warnings* warnings);

/// Loads the meshes that the description names, welds and repairs them, and makes what is missing (cage,
/// tets), from the cache where its content hash is known. A volume just made equals the cached one bit for
/// bit.
/// @throw std::invalid_argument with file and place.
ObjectModel buildObjectModel(const ObjectDescription& description, const VolumeSettings& settings = {});

}  // namespace softbody
