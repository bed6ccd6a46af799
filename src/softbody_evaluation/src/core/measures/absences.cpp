#include "softbody_evaluation/measures/absences.h"

#include <algorithm>
#include <cmath>

namespace softbody::evaluation {
namespace {

constexpr double kCoveredShare = 0.25, kNormalFactor = 1.2, kHold_s = 0.2;

bool absent(const FrameOcclusion& frame) { return frame.covered_share > kCoveredShare; }

/// p95 of the frames' mean errors before the first absence.
double errorBefore(const std::vector<FrameOcclusion>& frames) {
  std::vector<float> errors;
  for (auto frame = frames.begin(); frame != frames.end() && !absent(*frame); ++frame) {
    if (std::isfinite(frame->mean_error)) errors.push_back(static_cast<float>(frame->mean_error));
  }
  return summarize(std::move(errors)).p95;
}

/// Time from frame `end` until the error is normal and stays normal.
/// @param normal_of a frame's normal error.
template <typename NormalOf>
std::optional<double> recovery(const std::vector<FrameOcclusion>& frames, std::size_t end,
                               NormalOf normal_of) {
  std::size_t since = end;
  for (std::size_t i = end; i < frames.size(); ++i) {
    if (!(frames[i].mean_error <= kNormalFactor * normal_of(frames[i]))) since = i + 1;
    if (since <= i && frames[i].time_s - frames[since].time_s >= kHold_s)
      return frames[since].time_s - frames[end].time_s;
  }
  return std::nullopt;
}

Absence absenceOf(const std::vector<FrameOcclusion>& frames, std::size_t begin, std::size_t end,
                  double before) {
  const FrameOcclusion& back = frames[std::min(end, frames.size() - 1)];
  Absence absence;
  absence.begin_s = frames[begin].time_s;
  absence.end_s = back.time_s;
  absence.normal = back.unhidden_error.value_or(before);
  std::vector<float> errors;
  for (std::size_t i = begin; i < end; ++i) {
    absence.covered_share = std::max(absence.covered_share, frames[i].covered_share);
    errors.insert(errors.end(), frames[i].covered_errors.begin(), frames[i].covered_errors.end());
  }
  absence.covered = summarize(std::move(errors));
  absence.recovery_s = recovery(
      frames, end, [&](const FrameOcclusion& frame) { return frame.unhidden_error.value_or(before); });
  absence.recovery_to_before_s = recovery(frames, end, [&](const FrameOcclusion&) { return before; });
  return absence;
}

}  // namespace

std::vector<Absence> absences(const std::vector<FrameOcclusion>& frames) {
  const double before = errorBefore(frames);
  std::vector<Absence> all;
  for (std::size_t begin = 0, end = 0; begin < frames.size(); begin = std::max(end, begin + 1)) {
    for (end = begin; end < frames.size() && absent(frames[end]);) ++end;
    if (end == begin) continue;
    const Absence absence = absenceOf(frames, begin, end, before);
    if (absence.end_s - absence.begin_s >= kHold_s) all.push_back(absence);
  }
  return all;
}

}  // namespace softbody::evaluation
