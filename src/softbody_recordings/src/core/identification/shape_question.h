#pragma once

#include <functional>
#include <string>
#include <vector>

#include "identification/material_question.h"
#include "softbody_sim/identification/material_estimate.h"
#include "softbody_sim/object/object_description.h"

namespace softbody {

/// A force on a region of the body.
struct RegionLoad {
  std::string region;                               ///< as boxOf() reads it
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< [N]
};

/// One static shape of the body, in the frame of its rest shape.
struct ShapeQuestion {
  MaterialQuestion material;
  std::string shape;              ///< surface file: its vertices are the measured points
  double unit_m = 1.0;            ///< of the file
  std::vector<std::string> pins;  ///< regions that are held, as boxOf() reads them; also those of the object
  std::vector<RegionLoad> loads;
};

/// A problem and its solution.
struct MaterialAnswer {
  MaterialProblem problem;
  MaterialEstimate estimate;
};

/// @param warn called with warnings. @throw std::invalid_argument with what cannot be used, and what to do.
MaterialAnswer answer(const ShapeQuestion& question, const ObjectDescription& description,
                      const ObjectModel& model, const std::function<void(const std::string&)>& warn,
                      const std::function<void(double)>& progress);

}  // namespace softbody
