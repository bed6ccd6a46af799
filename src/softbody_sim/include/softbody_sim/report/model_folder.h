#pragma once

#include <iosfwd>
#include <string>

#include "softbody_sim/object/object_model.h"

namespace softbody {

/// What a prepared model is good for.
enum class Verdict { kGood, kLookHere, kBad };

/// "good", "look here" or "bad".
const char* nameOf(Verdict verdict);

/// Share of prepareModel()'s progress at which the model is made and the report begins.
constexpr double kModelShare = 0.8;

/// Lowest and highest number that a user of prepareModel() may ask for.
struct AllowedCount {
  int least, most;
};

constexpr AllowedCount kShellNumbers{1, 100};           ///< of BodyOptions::shell
constexpr AllowedCount kTriangleCounts{100, 10000000};  ///< of BodyOptions::triangles
constexpr AllowedCount kCageVertexCounts{20, 20000};    ///< of VolumeSettings::cage_vertices

/// The user's mesh.
struct ModelSource {
  std::string mesh;        ///< OBJ, PLY, STL or OFF
  std::string unit = "m";  ///< m, cm, mm or inch
  double scale = 0.0;      ///< metres per unit of the mesh; above 0, it replaces the unit
  BodyOptions body = {};
};

/// Writes FOLDER/{object.yaml, visual.obj, cage.obj, tets.vtu, report/report.md, report/models.png} in
/// metres; and visual.mtl with visual.png or visual.jpg, if the mesh has a picture. Other files in the folder
/// stay. If anything fails, the folder is unchanged. Files of these names are replaced only if prepare_model
/// made them.
/// @param settings their `progress` may throw to end the work; 1 means that the folder is written. @param
/// output gets the report. @return the verdict.
/// @throw std::invalid_argument if the mesh is refused; std::runtime_error if the folder cannot be written.
Verdict prepareModel(const ModelSource& source, const std::string& folder, const VolumeSettings& settings,
                     std::ostream& output);

}  // namespace softbody
