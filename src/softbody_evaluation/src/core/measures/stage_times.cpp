#include "softbody_evaluation/measures/stage_times.h"

#include <tuple>

namespace softbody::evaluation {

bool operator<(const StageName& a, const StageName& b) {
  return std::tie(a.node, a.initialization, a.stage) < std::tie(b.node, b.initialization, b.stage);
}

std::map<StageName, Summary> summarize(const StageTimes& times) {
  std::map<StageName, Summary> summaries;
  for (const auto& [name, milliseconds] : times) summaries[name] = summarize(milliseconds);
  return summaries;
}

}  // namespace softbody::evaluation
