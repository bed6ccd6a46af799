#pragma once

#include <string>
#include <vector>

#include "report/model_quality.h"
#include "report/model_trial.h"
#include "softbody_sim/report/model_folder.h"

namespace softbody {

/// What one property of a prepared model means for tracking.
struct Judgement {
  Verdict verdict;
  std::string sentence;  ///< with the value, and what to do unless it is good
};

/// @param longest_side of the visual mesh's bounding box [m].
std::vector<Judgement> judge(const ModelQuality& quality, double longest_side);

/// What the trial of a model means. @param triangles of the visual mesh.
std::vector<Judgement> judge(const ModelTrial& trial, int triangles);

/// All of a model: its properties, a trial, and the warnings of its making.
std::vector<Judgement> judgementsOf(const ObjectModel& model, const ModelQuality& quality);

/// The worst of them.
Verdict worst(const std::vector<Judgement>& judgements);

}  // namespace softbody
