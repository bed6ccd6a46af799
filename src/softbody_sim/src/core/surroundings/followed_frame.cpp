#include "softbody_sim/surroundings/followed_frame.h"

#include <fmt/format.h>

#include "softbody_common/time/time.h"

namespace softbody {

namespace {

/// Robots send their frames ten times a second or more often.
constexpr double kTimeout_s = 1.0;

}  // namespace

void FollowedFrame::update(const FrameLookup& lookup, Nanoseconds stamp, LogLines* log) {
  if (const auto found = findFrame(lookup, frame_, stamp)) {
    pose_ = found->pose;
    seen_ = found->stamp;
  }
  if (!seen_ || *seen_ > stamp) seen_ = stamp;  // the first time, or after a jump back of time
  report(seconds(stamp - *seen_), log);
}

void FollowedFrame::report(double silence_s, LogLines* log) {
  if (silence_s <= kTimeout_s && pose_)
    fault_.end(fmt::format("tf gives the pose of frame '{}' again: {} follows it", frame_, owner_), log);
  else if (silence_s > kTimeout_s && pose_)
    fault_.begin(fmt::format("tf has no new pose of frame '{}' for {:.1f} s: {} stays at its last pose",
                             frame_, silence_s, owner_),
                 log);
  else if (silence_s > kTimeout_s)
    reportUnknown(log);
}

void FollowedFrame::reportUnknown(LogLines* log) {
  fault_.begin(
      fmt::format(
          "waiting for frame '{}': tf does not know it, and {} does not act; check the name, and that "
          "a node publishes the frame",
          frame_, owner_),
      log);
}

}  // namespace softbody
