#include "identification/recorded_observations.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "identification/mean_wrench.h"
#include "identification/rigid_pins.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/protocol/target_limits.h"
#include "softbody_common/time/time.h"

namespace softbody {
namespace {

/// Less motion does not show.
constexpr double kNoticeable_m = kTargetAccuracy_m;
constexpr double kShortestRest_s = 0.5;   // a pendulum of a body that can be tracked is faster
constexpr std::size_t kMostImages = 30;   // of one observation; more repeat the same errors
constexpr std::size_t kMostMoments = 24;  // of a motion

/// Frames [begin, end).
struct Section {
  std::size_t begin = 0, end = 0;
};

double moved(const Points& a, const Points& b) {
  return std::sqrt((a - b).squaredNorm() / static_cast<double>(std::max<Eigen::Index>(1, a.rows())));
}

double moved(const SeenFrame& a, const SeenFrame& b) {
  double largest = 0.0;
  if (a.around.pins != b.around.pins || a.around.obstacles != b.around.obstacles)
    return std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < a.around.all.pins.size(); ++k)
    largest = std::max(largest, (a.around.all.pins[k].position - b.around.all.pins[k].position).norm());
  for (std::size_t k = 0; k < a.around.all.obstacles.size(); ++k)
    largest = std::max(
        largest,
        (a.around.all.obstacles[k].pose.translation() - b.around.all.obstacles[k].pose.translation()).norm());
  return largest;
}

/// The last frames in which the body rests, or nothing.
Section lastRest(const std::vector<SeenFrame>& frames) {
  for (std::size_t end = frames.size(); end > 0; --end) {
    std::size_t begin = end - 1;
    while (begin > 0 && moved(frames[begin - 1].vertices, frames[end - 1].vertices) < 0.5 * kNoticeable_m)
      --begin;
    if (seconds(frames[end - 1].stamp - frames[begin].stamp) >= kShortestRest_s) return {begin, end};
  }
  return {};
}

/// Up to `most` of the section's frames, evenly spaced, the last one included.
std::vector<std::size_t> spread(const Section& section, std::size_t most) {
  const std::size_t count = section.end - section.begin, used = std::min(count, most);
  std::vector<std::size_t> chosen;
  for (std::size_t k = 1; k <= used; ++k) chosen.push_back(section.begin + k * count / used - 1);
  return chosen;
}

/// A pin holds from the frame after that in which the body is found.
std::vector<SeenFrame> heldFrames(std::vector<SeenFrame> frames) {
  const auto is_held = [](const SeenFrame& frame) {
    return !frame.around.pins.empty() || !frame.around.obstacles.empty();
  };
  frames.erase(frames.begin(), std::find_if(frames.begin(), frames.end(), is_held));
  if (frames.empty())
    throw std::invalid_argument(
        "no pin or obstacle acts in the used part of the recording: are their frames on /tf?");
  return frames;
}

class Builder {
 public:
  Builder(const std::vector<SeenFrame>& frames, const std::vector<WrenchRecord>& wrenches, const Points& rest)
      : frames_(frames), wrenches_(wrenches), pins_(rigidPins(frames, rest, kNoticeable_m)) {}

  /// The targets of some frames in the surroundings of the last of them.
  ShapeObservation observation(const std::vector<std::size_t>& chosen) {
    const SeenFrame& last = frames_[chosen.back()];
    ShapeObservation observation;
    observation.stamp = last.stamp;
    observation.surroundings = last.around.all;
    observation.surroundings.pins = pins_[chosen.back()];
    observation.surroundings.loads.resize(0, 3);
    for (const std::size_t k : chosen) {
      for (const Target& target : frames_[k].targets) observation.targets.push_back(target);
      observation.images.insert(observation.images.end(), frames_[k].targets.size(), image_);
      ++image_;
    }
    for (std::size_t w = 0; w < wrenches_.size(); ++w)
      if (auto wrench = meanWrench(wrenches_[w], last.around, frames_[chosen.front()].stamp, last.stamp)) {
        wrench->sensor = static_cast<int>(w);
        observation.wrenches.push_back(*wrench);
      }
    return observation;
  }

 private:
  const std::vector<SeenFrame>& frames_;
  const std::vector<WrenchRecord>& wrenches_;
  std::vector<std::vector<Pin>> pins_;  ///< per frame
  int image_ = 0;
};

double since(const std::vector<SeenFrame>& frames, std::size_t k) {
  return seconds(frames[k].stamp - frames.front().stamp);
}

}  // namespace

RecordedObservations observationsOf(const std::vector<SeenFrame>& all_frames,
                                    const std::vector<WrenchRecord>& wrenches, const Points& rest_vertices,
                                    bool swings) {
  const std::vector<SeenFrame> frames = heldFrames(all_frames);
  Builder builder(frames, wrenches, rest_vertices);
  RecordedObservations recorded;
  double way = 0.0;
  for (const SeenFrame& frame : frames) way = std::max(way, moved(frames.back(), frame));
  const Section all{0, frames.size()};
  if (swings || way > kNoticeable_m) {
    const auto chosen = spread(all, swings ? frames.size() : kMostMoments);
    for (const std::size_t k : chosen) recorded.observations.push_back(builder.observation({k}));
    recorded.sentence =
        fmt::format("used: {} moments from {:.2f} to {:.2f} s of the tracked time", chosen.size(),
                    since(frames, chosen.front()), since(frames, chosen.back()));
  } else {
    const Section rest = lastRest(frames);
    if (rest.end == 0)
      throw std::invalid_argument(fmt::format(
          "the body never rests for {} s in the recording: wait until it hangs still, or find its "
          "damping from its swing (--free e,damping)",
          kShortestRest_s));
    const auto chosen = spread(rest, kMostImages);
    recorded.observations.push_back(builder.observation(chosen));
    recorded.sentence =
        fmt::format("used: {} images of the body at rest, from {:.2f} to {:.2f} s of the tracked time",
                    chosen.size(), since(frames, rest.begin), since(frames, rest.end - 1));
  }
  const Points& first = frames.front().vertices;
  recorded.body_pose = fitRigid(rest_vertices, first);
  return recorded;
}

}  // namespace softbody
