#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

enum class Severity {
  kWarning,  ///< tracking works, but worse than it could
  kError     ///< tracking is not possible with this recording
};

/// One fault of a recording, and what to do about it.
struct Finding {
  Severity severity = Severity::kError;
  std::string check;     ///< name of the check, e.g. "sync"
  std::string topic;     ///< topic with the fault; empty: the sentence names it
  std::string sentence;  ///< with the values and the remedy
};

using Findings = std::vector<Finding>;

/// Whether there is no error.
bool usable(const Findings& findings);

/// One line per finding, and a verdict.
std::string toText(const RecordingFacts& facts, const Findings& findings);
nlohmann::json toJson(const RecordingFacts& facts, const Findings& findings);

}  // namespace softbody::validation
