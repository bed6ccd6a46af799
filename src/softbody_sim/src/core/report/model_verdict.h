#pragma once

#include <string>
#include <vector>

#include "report/model_quality.h"

namespace softbody {

enum class Verdict { kGood, kLookHere, kBad };

/// What one property of a prepared model means for tracking.
struct Judgement {
  Verdict verdict;
  std::string sentence;  ///< with the value, and what to do unless it is good
};

/// @param longest_side of the visual mesh's bounding box [m].
std::vector<Judgement> judge(const ModelQuality& quality, double longest_side);

/// The worst of them.
Verdict worst(const std::vector<Judgement>& judgements);

/// "good", "look here" or "bad".
const char* nameOf(Verdict verdict);

}  // namespace softbody
