#pragma once

#include <string>
#include <vector>

#include "softbody_evaluation/measures/pose_error.h"
#include "softbody_evaluation/records/surface_record.h"

namespace softbody::evaluation {

/// Transforms the surface's states into another frame by the /tf and /tf_static of these bags, at each
/// state's stamp. Leaves out states without a transform, and adds a note.
/// @param states name of the states in the note.
/// @throw std::invalid_argument if no state has a transform.
void expressIn(const std::string& frame_id, const std::vector<std::string>& paths, SurfaceRecord* surface,
               const std::string& states = "states");

/// Transforms a tool's poses in the same way. It is no error if no pose is left.
void expressIn(const std::string& frame_id, const std::vector<std::string>& paths, ToolRecord* tool);

/// Adds the notes that are not in the list yet.
void addNotes(const std::vector<std::string>& more, std::vector<std::string>* notes);

}  // namespace softbody::evaluation
