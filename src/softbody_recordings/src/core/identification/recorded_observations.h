#pragma once

#include <string>
#include <vector>

#include "identification/seen_frame.h"
#include "softbody_sim/identification/material_problem.h"

namespace softbody {

/// Observations of a recording of a body, and what was chosen, in a sentence.
struct RecordedObservations {
  std::vector<ShapeObservation> observations;
  Eigen::Isometry3d body_pose = Eigen::Isometry3d::Identity();  ///< rest frame in the fixed frame, at first
  std::string sentence;
};

/// Where pins and obstacles stay where they are, the last time for which the body hangs still is one
/// observation with the targets of many images. Where they move, the body is seen at evenly spaced moments of
/// their motion; it is taken to be in balance in each.
/// @param frames by stamp, not empty. @param rest_vertices #V by 3 [m]. @param swings uses all frames in a
/// row.
/// @throw std::invalid_argument with what the recording lacks, and what to do.
RecordedObservations observationsOf(const std::vector<SeenFrame>& frames,
                                    const std::vector<WrenchRecord>& wrenches, const Points& rest_vertices,
                                    bool swings);

}  // namespace softbody
