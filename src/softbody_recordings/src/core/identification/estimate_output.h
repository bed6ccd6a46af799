#pragma once

#include <string>

#include "softbody_sim/identification/material_estimate.h"

namespace softbody {

/// Where an estimate is written; empty: nowhere.
struct EstimateOutput {
  std::string object;  ///< the YAML that was read
  std::string yaml;    ///< gets the object YAML with the found material
  std::string folder;  ///< gets report.txt and fit.png
};

/// @throw std::invalid_argument if the YAML would not find the object's meshes.
void requireUsable(const EstimateOutput& output);

/// Writes whole files or none of them. The YAML only if Young's modulus or another property was found.
/// @return what was written, a line for each file.
std::string write(const EstimateOutput& output, const MaterialProblem& problem,
                  const MaterialEstimate& estimate, const std::string& report);

/// Whether everything that was asked for was found.
bool isComplete(const MaterialEstimate& estimate);

}  // namespace softbody
