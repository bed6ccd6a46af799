#include "nodes/surface/blade_input.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/frame_name.h"

namespace softbody {
namespace {

/// Blade and state further apart in time do not belong together.
constexpr Nanoseconds kSameInstant = 100'000'000;  // [ns]
/// States come later than blades, on a slow machine by many frames. After this time no state is expected.
constexpr Nanoseconds kLongestWait = 5'000'000'000;  // [ns]
constexpr std::size_t kMostWaiting = 5000;           // bounds memory for any stamps
constexpr int kBladeQueue = 100;                     // a fast tool sends many poses while one cut is made
/// Fewer skipped blades also occur when a bag starts again; they need no warning.
constexpr int kMostSkipped = 5;

}  // namespace

BladeInput::BladeInput(ros::NodeHandle node, Callback on_blade)
    : on_blade_(std::move(on_blade)),
      stamps_(node.resolveName(topics::kToolBlade), StampGate::Repeats::kAccepted) {
  subscriber_ = node.subscribe(topics::kToolBlade, kBladeQueue, &BladeInput::onBlade, this,
                               ros::TransportHints().tcpNoDelay());
}

void BladeInput::reset() {
  state_.reset();
  waiting_.clear();
}

void BladeInput::onState(const std_msgs::Header& header) {
  state_ = header;
  std::optional<Blade> last;
  while (!waiting_.empty() && waiting_.front().header.stamp <= header.stamp) {
    last = std::move(waiting_.front());
    waiting_.pop_front();
  }
  if (last) passOn(*last);
}

void BladeInput::onBlade(const geometry_msgs::PolygonStampedConstPtr& message) {
  try {
    Blade blade{message->header, fromMessage(message->polygon)};
    blade.header.frame_id = frameName(blade.header.frame_id, subscriber_.getTopic());
    add(std::move(blade));
  } catch (const std::invalid_argument& error) {
    ROS_WARN_STREAM_THROTTLE(5.0, subscriber_.getTopic()
                                      << " is not used: " << error.what() << "; rostopic info "
                                      << subscriber_.getTopic() << " names the sender");
  }
}

void BladeInput::add(Blade blade) {
  const ros::Time stamp = blade.header.stamp;
  const StampVerdict verdict = stamps_.judge(stamp);
  if (!stamps_.admits(verdict)) return;
  if (verdict.wentBack()) waiting_.clear();
  if (state_ && stamp <= state_->stamp) return passOn(blade);
  waiting_.push_back(std::move(blade));
  while (toNanoseconds(stamp) - toNanoseconds(waiting_.front().header.stamp) > kLongestWait ||
         waiting_.size() > kMostWaiting) {
    skip(waiting_.front().header.stamp);
    waiting_.pop_front();
  }
}

void BladeInput::passOn(const Blade& blade) {
  if (std::abs(toNanoseconds(state_->stamp) - toNanoseconds(blade.header.stamp)) > kSameInstant)
    return skip(blade.header.stamp);
  skipped_ = 0;
  const std::optional<Points> polygon = toStateFrame(blade);
  if (polygon) on_blade_(*polygon, blade.header.stamp);
}

void BladeInput::skip(const ros::Time& stamp) {
  if (!state_ || ++skipped_ < kMostSkipped) return;
  const double ahead = secondsBetween(state_->stamp, stamp);
  ROS_WARN_STREAM_THROTTLE(
      5.0,
      fmt::format("the blade cannot cut: its stamp {:.3f} s is {:.3f} s {} the body's last state; a blade "
                  "needs the stamp of an image in which the body is tracked",
                  stamp.toSec(), std::abs(ahead), ahead > 0.0 ? "after" : "before"));
}

std::optional<Points> BladeInput::toStateFrame(const Blade& blade) {
  if (blade.header.frame_id == state_->frame_id) return blade.corners;
  if (!transforms_) transforms_ = std::make_unique<TransformInput>();
  const std::string why = transforms_->whyMissing(state_->frame_id, blade.header.frame_id);
  if (!why.empty()) {
    ROS_WARN_STREAM_THROTTLE(5.0, "the blade cannot cut: " << why);
    return std::nullopt;
  }
  try {
    const auto T =
        transforms_->buffer().lookupTransform(state_->frame_id, blade.header.frame_id, blade.header.stamp);
    return transformed(blade.corners, fromMessage(T.transform));
  } catch (const std::exception& error) {  // of tf2, or of a transform that is not usable
    ROS_WARN_STREAM_THROTTLE(5.0, "tf does not give the blade's pose: " << error.what());
    return std::nullopt;
  }
}

}  // namespace softbody
