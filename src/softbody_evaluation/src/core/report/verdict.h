#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "report/metrics.h"

namespace softbody::evaluation {

enum class Level { kGood, kSuspect, kWrong };

/// "good", "suspect" or "wrong".
std::string toText(Level level);

/// What one metric says against the result.
struct Finding {
  Level level = Level::kGood;
  std::string sentence;
};

/// What the metrics of a result say together: the worst of its findings.
struct Verdict {
  Level level = Level::kGood;
  std::vector<Finding> findings;    ///< the worst first; empty for a good result
  std::vector<std::string> limits;  ///< what the metrics cannot show, in sentences
  std::string premise = {};         ///< what to know before the metrics, in sentences; empty: nothing
};

/// Judges a result by the limits of its metrics. A result that was compared with nothing is suspect.
Verdict judge(const Report& report);

/// The level of one metric; kGood if it has no limits or no value.
Level levelOf(const std::string& metric, double value);
/// The limits of a metric in words; empty if it has none.
std::string limitsOf(const std::string& metric);

nlohmann::json toJson(const Verdict& verdict);

}  // namespace softbody::evaluation
