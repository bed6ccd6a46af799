#include "nodes/camera_ingest/camera_ingest_watch.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "camera/stream_advice.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
namespace {

constexpr double kCheckPeriod_s = 0.5;
// From an image's stamp to its complete frame. More is not a slow machine: the clocks differ.
constexpr double kLongestLatency_s = 2.0;
// Of a stamp before this machine's clock; clocks that are synchronised differ by milliseconds.
constexpr double kLongestLead_s = 0.1;
constexpr double kRemarkPeriod_s = 60.0;  // a remark holds for a whole run: not in every screen of the log
constexpr char kSilentClock[] =
    "use_sim_time is set, but /clock is silent, so the nodes' timers stand still. For a live camera run "
    "rosparam "
    "set use_sim_time false, and start the nodes again; a bag needs rosbag play --clock";
constexpr double kStartTimeouts = 5.0;  // a camera may take this many silence timeouts to start

/// The image, as in "a late image".
std::string wordsFor(const RefusedStamp& refused) {
  switch (refused.verdict.kind) {
    case StampVerdict::kUnstamped:
      return "an image without a stamp";
    case StampVerdict::kLate:
      return "a late image";
    case StampVerdict::kRepeated:
      return fmt::format("a second image with the stamp {:.6f}", seconds(refused.stamp));
    default:
      return fmt::format("an image with the odd stamp {:.6f}", seconds(refused.stamp));
  }
}

bool clockIsSilent() { return ros::Time::isSimTime() && ros::Time::now().isZero(); }

}  // namespace

CameraIngestWatch::CameraIngestWatch(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle,
                                     Nanoseconds tolerance, double silence_timeout_s,
                                     std::function<StreamTopics()> topics)
    : silence_timeout_s_(silence_timeout_s),
      tolerance_(tolerance),
      topics_(std::move(topics)),
      own_namespace_(handle.getNamespace()),
      monitor_(tolerance_, nanoseconds(silence_timeout_s)),
      sync_(tolerance_),
      watchdog_(silence_timeout_s),
      start_(ros::WallTime::now()),
      last_diagnosis_(start_),
      diagnostics_(
          handle, private_handle, "frames", [this](auto& status) { diagnose(status); }, "RGB-D camera") {
  diagnostics_.add("sync offset", [this](auto& status) { diagnoseSync(status); });
  // Wall time: without /clock a simulated timer never fires, and that must be reported.
  timer_ = handle.createWallTimer(ros::WallDuration(kCheckPeriod_s), [this](const auto&) { check(); });
}

void CameraIngestWatch::noteImage(Stream stream, const ros::Time& stamp, const StampVerdict& verdict) {
  const Nanoseconds time = toNanoseconds(stamp);
  if (const auto refused = refused_stamps_[static_cast<std::size_t>(stream)].note(time, verdict))
    logDropped(stream, *refused);
  if (verdict.kind == StampVerdict::kUnstamped) monitor_.noteUnstamped(stream);
  if (!verdict.accepted()) return;
  if (verdict.kind == StampVerdict::kJumpedBack) {
    if (stream == Stream::kColor)
      ROS_INFO_STREAM("time jumped back by " << -seconds(verdict.gap) << " s: a new pass starts");
    monitor_.noteFrame();
  }
  const Nanoseconds now = toNanoseconds(ros::Time::now());
  monitor_.noteArrival(stream, time, now);
  stream == Stream::kColor ? sync_.noteColor(time, now) : sync_.noteDepth(time, now);
}

void CameraIngestWatch::logDropped(Stream stream, const RefusedStamp& refused) {
  const StampVerdict& verdict = refused.verdict;
  const std::string topic = topics_()[static_cast<std::size_t>(stream)].name;
  throttle_.warn(fmt::format("{} {}", topic, static_cast<int>(verdict.kind)),
                 fmt::format("{}: {} is dropped: {}", topic, wordsFor(refused), whyRefused(verdict)));
}

void CameraIngestWatch::noteInfo(const ros::Time& stamp) {
  monitor_.noteArrival(Stream::kColorInfo, toNanoseconds(stamp), toNanoseconds(ros::Time::now()));
}

void CameraIngestWatch::noteFrame(const std_msgs::Header& color) {
  ++frames_;
  watchdog_.frameArrived();
  latency_s_ = secondsBetween(color.stamp, ros::Time::now());
  color_frame_ = withoutSlash(color.frame_id);
  monitor_.noteFrame();
}

void CameraIngestWatch::noteRefusal(const std::string& why) {
  ++refused_;
  monitor_.noteRefusal(why);
  throttle_.warn("refused", why);
}

double CameraIngestWatch::secondsWithoutFrame() const {
  // Before the first frame /clock itself may be missing. Later a paused bag is not silent.
  return watchdog_.silence().value_or((ros::WallTime::now() - start_).toSec());
}

bool CameraIngestWatch::isStarting() const {
  if (hasFrames()) return false;
  // Images that arrive but make no frame are a fault.
  if (!both_came_.isZero()) return (ros::WallTime::now() - both_came_).toSec() < silence_timeout_s_;
  return secondsWithoutFrame() < kStartTimeouts * silence_timeout_s_;
}

std::string CameraIngestWatch::silence() const {
  return fmt::format("{} {:.0f} s: {}", isStarting() ? "waiting for the first frame for" : "no frame for",
                     secondsWithoutFrame(), complaint());
}

std::string CameraIngestWatch::complaint() const {
  if (clockIsSilent()) return kSilentClock;
  const Nanoseconds now = toNanoseconds(ros::Time::now());
  const StreamTopics topics = topics_();
  std::string sentence = monitor_.diagnosis(topics, now);
  const std::vector<StreamMonitor::Silent> silent = monitor_.silentStreams(now);
  if (silent.empty()) return sentence;
  const std::map<std::string, std::string> published = publishedTopics();
  return sentence + "; " + adviceOn(silent, topics, published);
}

/// Types by topic, without the graph's own topics.
std::map<std::string, std::string> CameraIngestWatch::publishedTopics() const {
  ros::master::V_TopicInfo topics;
  ros::master::getTopics(topics);
  std::map<std::string, std::string> types;
  for (const ros::master::TopicInfo& topic : topics)
    if (topic.name.rfind(own_namespace_ + "/", 0) != 0) types[topic.name] = topic.datatype;
  return types;
}

std::vector<CameraIngestWatch::Remark> CameraIngestWatch::remarks() const {
  const StreamTopics topics = topics_();
  const std::string& color = topics[static_cast<std::size_t>(Stream::kColor)].name;
  std::vector<Remark> remarks;
  if (clockIsSilent()) remarks.push_back({"silent clock", kSilentClock});
  if (color_frame_.empty())
    remarks.push_back(
        {"no frame", fmt::format("{} has no frame_id, so no result has one: set the frame_id of "
                                 "the driver's optical frame",
                                 color)});
  // A simulated clock is made of the stamps, and lags behind them.
  if (!ros::Time::isSimTime() && (latency_s_ > kLongestLatency_s || latency_s_ < -kLongestLead_s))
    remarks.push_back(
        {"clock", fmt::format("stamps are {:.1f} s {} this machine's clock, which tf and timers use: "
                              "synchronise the camera's clock; a bag needs use_sim_time and --clock",
                              std::abs(latency_s_), latency_s_ > 0.0 ? "behind" : "ahead of")});
  return remarks;
}

void CameraIngestWatch::check() {
  if (both_came_.isZero() && monitor_.hasArrived(Stream::kColor) && monitor_.hasArrived(Stream::kDepth))
    both_came_ = ros::WallTime::now();
  if (secondsWithoutFrame() > silence_timeout_s_) {
    if (isStarting())
      throttle_.info("start", silence());
    else
      throttle_.warn("silence", silence());
  }
}

void CameraIngestWatch::diagnose(NodeDiagnostics::Status& status) {
  using diagnostic_msgs::DiagnosticStatus;
  const double period = (ros::WallTime::now() - last_diagnosis_).toSec();
  const double rate = frames_ / std::max(period, 1e-3);
  std::vector<std::string> odd;
  for (const Remark& remark : frames_ > 0 ? remarks() : std::vector<Remark>()) {
    throttle_.warn(remark.kind, remark.sentence, kRemarkPeriod_s);
    odd.push_back(remark.sentence);
  }
  if (secondsWithoutFrame() > silence_timeout_s_) {
    status.summary(isStarting() ? DiagnosticStatus::WARN : DiagnosticStatus::ERROR, silence());
  } else if (refused_ > 0) {
    status.summary(DiagnosticStatus::WARN,
                   fmt::format("{} frames could not be used: {}", refused_, complaint()));
  } else if (!odd.empty()) {
    status.summary(DiagnosticStatus::WARN, fmt::format("{}", fmt::join(odd, "; ")));
  } else {
    status.summary(DiagnosticStatus::OK, fmt::format("{:.1f} frames a second", rate));
  }
  status.add("frames per second", fmt::format("{:.1f}", rate));
  status.add("frames refused", refused_);
  status.add("latency [ms]", fmt::format("{:.1f}", std::max(0.0, latency_s_) * 1e3));
  const StreamTopics topics = topics_();
  status.add("colour", topics[static_cast<std::size_t>(Stream::kColor)].name);
  status.add("depth", topics[static_cast<std::size_t>(Stream::kDepth)].name);
  frames_ = refused_ = 0;
  last_diagnosis_ = ros::WallTime::now();
}

void CameraIngestWatch::diagnoseSync(NodeDiagnostics::Status& status) const {
  using diagnostic_msgs::DiagnosticStatus;
  const SyncMonitor::Offsets offsets = sync_.offsets(toNanoseconds(ros::Time::now()));
  const double mean_ms = 1e3 * offsets.mean_s, worst_ms = 1e3 * offsets.worst_s,
               allowed_ms = 1e-6 * tolerance_;
  if (offsets.colors == 0) {
    status.summary(DiagnosticStatus::WARN, "colour and depth have not come together in the last seconds");
  } else if (offsets.beyond > 0) {
    status.summary(
        DiagnosticStatus::WARN,
        fmt::format("{} of {} colour images have no depth image within {:.1f} ms; mean offset {:.1f} "
                    "ms, worst {:.1f} ms: switch on the driver's synchronization",
                    offsets.beyond, offsets.colors, allowed_ms, mean_ms, worst_ms));
  } else {
    status.summary(DiagnosticStatus::OK,
                   fmt::format("colour and depth are {:.1f} ms apart, at most {:.1f} ms", mean_ms, worst_ms));
  }
  status.add("mean offset [ms]", fmt::format("{:.2f}", mean_ms));
  status.add("worst offset [ms]", fmt::format("{:.2f}", worst_ms));
  status.add("tolerance [ms]", fmt::format("{:.2f}", allowed_ms));
  status.add("colour images", offsets.colors);
  status.add("colour images without depth", offsets.beyond);
}

}  // namespace softbody
