#pragma once

#include <map>
#include <string>
#include <utility>

#include "softbody_evaluation/measures/statistics.h"

namespace softbody::evaluation {

/// A stage of a node. Initialisations have separate rows.
struct StageName {
  std::string node, stage;
  bool initialization = false;
};

bool operator<(const StageName& a, const StageName& b);

/// Times by stage, as the nodes measured them [ms].
using StageTimes = std::map<StageName, std::vector<float>>;

/// Statistics of every stage [ms].
std::map<StageName, Summary> summarize(const StageTimes& times);

}  // namespace softbody::evaluation
