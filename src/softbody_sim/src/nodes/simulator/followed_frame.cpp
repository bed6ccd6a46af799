#include "nodes/simulator/followed_frame.h"

#include <fmt/format.h>

namespace softbody {

void FollowedFrame::update(const FramePoses& poses, const std::string& target_frame, const ros::Time& stamp) {
  const double now_s = stamp.toSec();
  if (const auto found = poses.find(frame_, target_frame, stamp)) {
    pose_ = found->pose;
    seen_s_ = found->stamp.toSec();
  }
  if (!seen_s_ || *seen_s_ > now_s) seen_s_ = now_s;  // the first time, or after a jump back of time
  report(now_s - *seen_s_);
}

void FollowedFrame::report(double silence_s) {
  if (silence_s <= timeout_s_ && pose_)
    fault_.end(fmt::format("tf gives the pose of frame '{}' again: {} follows it", frame_, owner_));
  else if (silence_s > timeout_s_ && pose_)
    fault_.begin(fmt::format("tf has no new pose of frame '{}' for {:.1f} s: {} stays at its last pose",
                             frame_, silence_s, owner_));
  else if (silence_s > timeout_s_)
    reportUnknown();
}

void FollowedFrame::reportUnknown() {
  fault_.begin(fmt::format(
      "waiting for frame '{}': tf does not know it, and {} does not act; check the name, and that "
      "a node publishes the frame",
      frame_, owner_));
}

}  // namespace softbody
