#pragma once

#include <iosfwd>
#include <string>

#include "softbody_sim/object/object_model.h"

namespace softbody {

/// Writes FOLDER/{object.yaml, visual.obj, cage.obj, tets.vtu, report/report.md, report/models.png} in
/// metres. Other files in the folder stay. If anything fails, the folder is unchanged.
/// @param unit of the mesh: m, cm, mm or inch. @param output gets the report.
/// @throw std::invalid_argument if the mesh is refused; std::runtime_error if the folder cannot be written.
void prepareModel(const std::string& mesh, const std::string& unit, const std::string& folder,
                  const VolumeSettings& settings, std::ostream& output);

}  // namespace softbody
