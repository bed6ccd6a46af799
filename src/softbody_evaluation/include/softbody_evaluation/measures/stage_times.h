#pragma once

#include <map>
#include <string>
#include <utility>

#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// A stage of a node; initialisations are rows of their own.
struct StageName {
  std::string node, stage;
  bool initialization = false;
};

bool operator<(const StageName& a, const StageName& b);

/// Milliseconds by stage, as the nodes measured them.
using StageTimes = std::map<StageName, std::vector<float>>;

/// Mean, p95 and so on of every stage [ms].
std::map<StageName, Summary> summarize(const StageTimes& times);

}  // namespace softbody::evaluation
