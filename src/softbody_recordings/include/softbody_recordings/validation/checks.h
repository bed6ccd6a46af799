#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

enum class Severity {
  kWarning,  ///< the tracker runs, but worse than it could
  kError     ///< the tracker cannot work with this
};

/// One thing that is wrong, and what to do about it.
struct Finding {
  Severity severity = Severity::kError;
  std::string check;     ///< which of the checks, e.g. "sync"
  std::string topic;     ///< where
  std::string sentence;  ///< names the numbers and the remedy
};

using Findings = std::vector<Finding>;

struct CheckLimits {
  double sync_tolerance_s = 0.015;  ///< camera_ingest's parameter of that name
  double slowest_rate_hz = 15.0;    ///< below, fast motion is lost between frames
  double shortest_s = 1.0;          ///< of the recording
  double nearest_m = 0.1, farthest_m = 10.0, usual_farthest_m = 4.0;  ///< median depth
  double smallest_valid_share = 0.2;                                  ///< of the depth pixels
};

/// Missing topics, with what the bag offers instead, and wrong types.
Findings checkTopics(const RecordingFacts& facts);
/// Encodings, sizes, frame ids; whether depth is registered to colour as far as these tell.
Findings checkImages(const RecordingFacts& facts);
/// Stamps that are zero, repeated or go back; the clock of the recording; rates and gaps.
Findings checkStamps(const RecordingFacts& facts, const CheckLimits& limits);
/// How far colour and depth are apart in time.
Findings checkSync(const RecordingFacts& facts, const CheckLimits& limits);
/// Depth that is missing or in another unit.
Findings checkDepth(const RecordingFacts& facts, const CheckLimits& limits);
/// Camera infos that are empty, implausible, unlike the images or change.
Findings checkIntrinsics(const RecordingFacts& facts);

/// All of them, errors first. Streams that are missing or of a wrong type are not checked further.
Findings check(const RecordingFacts& facts, const CheckLimits& limits = {});

bool usable(const Findings& findings);
/// A line a finding, and a verdict.
std::string toText(const RecordingFacts& facts, const Findings& findings);
nlohmann::json toJson(const RecordingFacts& facts, const Findings& findings);

}  // namespace softbody::validation
