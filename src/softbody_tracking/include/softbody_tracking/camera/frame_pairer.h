#pragma once

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_common/time/timeline.h"

namespace softbody {

/// How colour and depth images are paired.
struct PairingConfig {
  Nanoseconds tolerance = 15'000'000;  ///< largest difference of stamps; 0: they must be equal
  bool every_color = false;            ///< every colour image makes a frame, also without depth (evaluation)
};

/// Images of a stream that may wait for their partners: a third of a second at 30 Hz.
constexpr std::size_t kMostWaiting = 10;

const ParameterTable<PairingConfig>& pairingParameters();

/// Images that are in no frame.
struct UnpairedImages {
  int unstamped = 0, outliers = 0;  ///< of both streams
  int colors_repeated = 0, depths_repeated = 0, colors_late = 0, depths_late = 0;
  int colors_alone = 0;  ///< no depth image came, and no frame without depth was allowed
  int depths_alone = 0;  ///< no colour image is near enough in time
};

/// Pairs each colour image with the depth image nearest in time. Live graph, replay and evaluation all use
/// this rule. It uses only the stamps and the order in which the images of each stream arrive, and no clock.
/// So a recording gives the same frames as the live graph.  An image with an odd stamp waits for the next
/// ones. If they follow it, time has moved and no image is lost (see Timeline). Otherwise it is dropped.  A
/// pair is complete as soon as no image nearer in time can come. Two facts show this. Stamps in a stream
/// increase. And the next image comes after at least half of the shortest gap so far. A pair with equal
/// stamps is complete at once. A colour image without a depth image makes a frame, too, but only within
/// kLongestWithoutDepth of one with depth. After that, the depth stream has stopped or has another clock.
/// @tparam ColorPtr, DepthPtr, InfoPtr pointers to the images and to the camera's description; null: none.
template <typename ColorPtr, typename DepthPtr, typename InfoPtr>
class FramePairer {
 public:
  struct Frame {
    Nanoseconds stamp;  ///< of the colour image
    int pass;           ///< how often the colour stream has started again
    ColorPtr color;
    DepthPtr depth;  ///< null: no depth image came within the tolerance
    InfoPtr info;    ///< the newest that has arrived
  };

  explicit FramePairer(const PairingConfig& config)
      : tolerance_(config.tolerance), every_color_(config.every_color) {}

  StampVerdict addColor(Nanoseconds stamp, ColorPtr color) {
    const StampVerdict verdict = colors_.add(stamp, std::move(color));
    count(verdict, &unpaired_.colors_repeated, &unpaired_.colors_late);
    return verdict;
  }

  StampVerdict addDepth(Nanoseconds stamp, DepthPtr depth) {
    const StampVerdict verdict = depths_.add(stamp, std::move(depth));
    count(verdict, &unpaired_.depths_repeated, &unpaired_.depths_late);
    while (depths_.images.size() > kMostWaiting) {
      ++unpaired_.depths_alone;
      depths_.drop(1);
    }
    return verdict;
  }

  /// Frames wait for the first info.
  void setInfo(InfoPtr info) { info_ = std::move(info); }

  /// The next frame that is complete. Frames come in the order of their stamps within a pass.
  /// @param finish true if no more images will come: then every pair is complete.
  std::optional<Frame> next(bool finish = false) {
    while (!colors_.images.empty()) {
      const bool overdue = colors_.images.size() > kMostWaiting;
      if (!info_ && !overdue) return std::nullopt;
      const auto [stamp, color, pass] = colors_.images.front();
      const Partner partner = partnerOf(stamp);
      if (!partner.certain && !overdue && !finish) return std::nullopt;
      colors_.images.pop_front();
      const bool makes_frame = partner.depth || every_color_ || (partner.certain && followsDepth(stamp));
      if (!info_ || !makes_frame) {
        ++unpaired_.colors_alone;
        continue;
      }
      Frame frame{stamp, pass, color, nullptr, info_};
      if (partner.depth) {
        frame.depth = depths_.images[*partner.depth].image;
        last_with_depth_ = stamp;
        unpaired_.depths_alone += static_cast<int>(*partner.depth);
        depths_.drop(*partner.depth + 1);
      }
      return frame;
    }
    return std::nullopt;
  }

  UnpairedImages unpaired() const {
    UnpairedImages unpaired = unpaired_;
    unpaired.colors_alone += static_cast<int>(colors_.images.size());
    unpaired.depths_alone += static_cast<int>(depths_.images.size());
    unpaired.outliers += colors_.outliers + depths_.outliers;
    return unpaired;
  }

 private:
  /// If depth is missing for longer, this is a fault that the user must see.
  static constexpr Nanoseconds kLongestWithoutDepth = 1'000'000'000;

  template <typename Pointer>
  struct Image {
    Nanoseconds stamp;
    Pointer image;
    int pass;
  };

  /// Images in the order of their stamps within a pass.
  template <typename Pointer>
  struct Queue {
    std::deque<Image<Pointer>> images;
    std::vector<std::pair<Nanoseconds, Pointer>> odd;  ///< outliers in a row: time may have moved
    Timeline timeline;
    Nanoseconds shortest_gap = std::numeric_limits<Nanoseconds>::max();
    int outliers = 0;  ///< dropped for good, and those in `odd`

    StampVerdict add(Nanoseconds stamp, Pointer image) {
      const StampVerdict verdict = timeline.judge(stamp);
      if (verdict.kind == StampVerdict::kOutlier) {
        if (verdict.in_a_row == 1) odd.clear();
        odd.emplace_back(stamp, std::move(image));
        ++outliers;
        return verdict;
      }
      if (!verdict.accepted()) return verdict;
      if (verdict.kind == StampVerdict::kInOrder) odd.clear();
      for (auto& [earlier_stamp, earlier] : std::exchange(odd, {})) {
        push(earlier_stamp, std::move(earlier));
        --outliers;
      }
      if (verdict.gap > 0) shortest_gap = std::min(shortest_gap, verdict.gap);
      push(stamp, std::move(image));
      return verdict;
    }

    void push(Nanoseconds stamp, Pointer image) {
      images.push_back({stamp, std::move(image), timeline.pass()});
    }

    void drop(std::size_t count) {
      images.erase(images.begin(), images.begin() + static_cast<std::ptrdiff_t>(count));
    }

    /// Whether the stream has moved away from this stamp.
    bool hasLeft(Nanoseconds stamp) const {
      return timeline.last() > 0 && std::llabs(timeline.last() - stamp) >= Timeline::kLeap;
    }

    /// Index of the image nearest in time; the first one of equally near images. Nothing if the queue is
    /// empty.
    std::optional<std::size_t> nearestTo(Nanoseconds stamp) const {
      const auto nearer = [stamp](const auto& a, const auto& b) {
        return std::llabs(a.stamp - stamp) < std::llabs(b.stamp - stamp);
      };
      const auto nearest = std::min_element(images.begin(), images.end(), nearer);
      if (nearest == images.end()) return std::nullopt;
      return static_cast<std::size_t>(nearest - images.begin());
    }

    /// Least time from a stamp to the next image; below 0 if it is not known.
    /// @param most upper limit of the gap that is expected after the last image.
    Nanoseconds nextIsLaterBy(Nanoseconds stamp, Nanoseconds most) const {
      constexpr Nanoseconds kUnknown = std::numeric_limits<Nanoseconds>::max();
      // A stream that is far ahead is still in the pass of a recording that the other stream has left.
      const Nanoseconds newest = timeline.last();
      if (newest == 0 || newest - stamp >= Timeline::kLeap) return -Timeline::kLeap;
      const Nanoseconds gap = shortest_gap == kUnknown ? 0 : std::min(shortest_gap / 2, most);
      const Nanoseconds least = std::max<Nanoseconds>(1, gap);
      return newest - stamp + least;
    }
  };

  /// The depth image of the first colour image.
  struct Partner {
    std::optional<std::size_t> depth;  ///< nothing: none of the depth images so far belongs to it
    bool certain = false;              ///< later images cannot change it
  };

  Partner partnerOf(Nanoseconds stamp) const {
    const std::optional<std::size_t> nearest = depths_.nearestTo(stamp);
    const Nanoseconds depth = nearest ? depths_.images[*nearest].stamp : 0;
    const Nanoseconds distance = std::llabs(depth - stamp);
    // No image near to this one will come.
    if (colors_.hasLeft(stamp) && depths_.hasLeft(stamp))
      return {distance <= tolerance_ ? nearest : std::nullopt, true};
    if (!nearest || distance > tolerance_)
      return {std::nullopt, depths_.nextIsLaterBy(stamp, tolerance_) > tolerance_};
    // A depth image that is nearer to a later colour image belongs to that one. Otherwise one dropped depth
    // image would shift all pairs.
    if (colors_.nearestTo(depth) != 0) return {std::nullopt, true};
    if (distance == 0) return {nearest, true};
    const bool no_nearer_depth = depths_.nextIsLaterBy(stamp, tolerance_) >= distance;
    const bool no_nearer_color = depth <= stamp || colors_.nextIsLaterBy(depth, tolerance_) >= distance;
    return {nearest, no_nearer_depth && no_nearer_color};
  }

  void count(const StampVerdict& verdict, int* repeated, int* late) {
    unpaired_.unstamped += verdict.kind == StampVerdict::kUnstamped ? 1 : 0;
    *repeated += verdict.kind == StampVerdict::kRepeated ? 1 : 0;
    *late += verdict.kind == StampVerdict::kLate ? 1 : 0;
  }

  /// Whether a frame with depth is near enough in time for one without.
  bool followsDepth(Nanoseconds stamp) const {
    return last_with_depth_ && std::llabs(stamp - *last_with_depth_) <= kLongestWithoutDepth;
  }

  Nanoseconds tolerance_;
  bool every_color_;
  Queue<ColorPtr> colors_;
  Queue<DepthPtr> depths_;
  InfoPtr info_{};
  std::optional<Nanoseconds>
      last_with_depth_;  ///< stamp of the last frame with depth; none: the next needs it
  UnpairedImages unpaired_;
};

}  // namespace softbody
