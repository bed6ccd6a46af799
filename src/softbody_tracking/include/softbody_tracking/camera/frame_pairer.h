#pragma once

#include <algorithm>
#include <cstdlib>
#include <deque>
#include <limits>
#include <optional>
#include <utility>

#include "softbody_common/parameters.h"
#include "softbody_common/types.h"

namespace softbody {

/// How colour and depth images are paired.
struct PairingConfig {
  bool exact = false;                  ///< stamps must be equal
  Nanoseconds tolerance = 15'000'000;  ///< largest difference of stamps if not exact
  int queue_size = 10;                 ///< largest number of waiting images of a stream
  bool every_color = false;            ///< every colour image makes a frame, also without depth (evaluation)
};

/// @throw std::invalid_argument with key, value and range.
PairingConfig readPairingConfig(Parameters& parameters);

/// What happened to an added image.
struct ImageArrival {
  enum Kind {
    kAccepted,
    kRestarted,  ///< accepted; its stamp is a second or more before the last one: the stream starts again
    kUnstamped,  ///< dropped: its stamp is not above 0
    kRepeated,   ///< dropped: it has the stamp of the previous image
    kLate        ///< dropped: its stamp is before the last one's
  };
  Kind kind;
  Nanoseconds gap = 0;  ///< its stamp minus the last image's stamp

  bool accepted() const { return kind == kAccepted || kind == kRestarted; }
};

/// Images that are in no frame.
struct UnpairedImages {
  int unstamped = 0, colors_repeated = 0, depths_repeated = 0, colors_late = 0, depths_late = 0;
  int colors_alone = 0;  ///< no depth image came, and no frame without depth was allowed
  int depths_alone = 0;  ///< no colour image is near enough in time
};

/// Pairs each colour image with the depth image nearest in time. Live graph, replay and evaluation all use
/// this rule. It uses only the stamps and the order in which the images of each stream arrive, and no clock.
/// So a recording gives the same frames as the live graph.
///
/// A pair is complete as soon as no image nearer in time can come. Two facts show this: stamps in a stream
/// increase, and the next image of a stream comes at least half of the shortest gap so far after the last
/// one. A pair with equal stamps is complete at once. A colour image without a depth image makes a frame,
/// too, but at most kMostWithoutDepth times in a row. After that, the depth stream has stopped or has another
/// clock.
/// @tparam ColorPtr, DepthPtr, InfoPtr pointers to the images and to the camera's description; null: none.
template <typename ColorPtr, typename DepthPtr, typename InfoPtr>
class FramePairer {
 public:
  struct Frame {
    Nanoseconds stamp;  ///< of the colour image
    ColorPtr color;
    DepthPtr depth;  ///< null: no depth image came within the tolerance
    InfoPtr info;    ///< the newest that has arrived
  };

  explicit FramePairer(const PairingConfig& config)
      : tolerance_(config.exact ? 0 : config.tolerance),
        queue_size_(static_cast<std::size_t>(config.queue_size)),
        every_color_(config.every_color) {}

  ImageArrival addColor(Nanoseconds stamp, ColorPtr color) {
    const ImageArrival arrival = colors_.add(stamp, std::move(color));
    count(arrival, &unpaired_.colors_repeated, &unpaired_.colors_late);
    return arrival;
  }

  ImageArrival addDepth(Nanoseconds stamp, DepthPtr depth) {
    const ImageArrival arrival = depths_.add(stamp, std::move(depth));
    count(arrival, &unpaired_.depths_repeated, &unpaired_.depths_late);
    if (depths_.images.size() > queue_size_) {
      ++unpaired_.depths_alone;
      depths_.drop(1);
    }
    return arrival;
  }

  /// Frames wait for the first info.
  void setInfo(InfoPtr info) { info_ = std::move(info); }

  /// The next frame that is complete. Frames come in the order of their stamps.
  /// @param finish true if no more images will come: then every pair is complete.
  std::optional<Frame> next(bool finish = false) {
    while (!colors_.images.empty()) {
      const bool overdue = colors_.images.size() > queue_size_;
      if (!info_ && !overdue) return std::nullopt;
      const auto [stamp, color] = colors_.images.front();
      const Partner partner = partnerOf(stamp);
      if (!partner.certain && !overdue && !finish) return std::nullopt;
      colors_.images.pop_front();
      const bool makes_frame =
          partner.depth || every_color_ || (partner.certain && ++without_depth_ <= kMostWithoutDepth);
      if (!info_ || !makes_frame) {
        ++unpaired_.colors_alone;
        continue;
      }
      Frame frame{stamp, color, nullptr, info_};
      if (partner.depth) {
        frame.depth = depths_.images[*partner.depth].second;
        without_depth_ = 0;
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
    return unpaired;
  }

 private:
  /// One second at 30 Hz. If depth is missing for longer, this is a fault that the user must see.
  static constexpr int kMostWithoutDepth = 30;
  /// If a stamp goes back by this much, a recording starts again. If it goes back by less, the image is late.
  static constexpr Nanoseconds kRestart = 1'000'000'000;

  /// Images in the order of their stamps.
  template <typename Pointer>
  struct Queue {
    std::deque<std::pair<Nanoseconds, Pointer>> images;
    Nanoseconds newest = 0;  ///< stamp of the last image; 0: none came
    Nanoseconds shortest_gap = std::numeric_limits<Nanoseconds>::max();

    ImageArrival add(Nanoseconds stamp, Pointer image) {
      if (stamp <= 0) return {ImageArrival::kUnstamped};
      const Nanoseconds gap = newest > 0 ? stamp - newest : 0;
      if (newest > 0 && gap == 0) return {ImageArrival::kRepeated};
      if (gap < 0 && gap > -kRestart) return {ImageArrival::kLate, gap};
      if (gap > 0) shortest_gap = std::min(shortest_gap, gap);
      newest = stamp;
      images.emplace_back(stamp, std::move(image));
      return {gap < 0 ? ImageArrival::kRestarted : ImageArrival::kAccepted, gap};
    }

    void drop(std::size_t count) {
      images.erase(images.begin(), images.begin() + static_cast<std::ptrdiff_t>(count));
    }

    /// Whether the stream has jumped back since an image of this stamp.
    bool restartedSince(Nanoseconds stamp) const { return newest > 0 && newest <= stamp - kRestart; }

    /// Index of the image nearest in time; the first one of equally near images. Nothing if the queue is
    /// empty.
    std::optional<std::size_t> nearestTo(Nanoseconds stamp) const {
      const auto nearer = [stamp](const auto& a, const auto& b) {
        return std::llabs(a.first - stamp) < std::llabs(b.first - stamp);
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
      if (newest == 0 || newest - stamp >= kRestart) return -kRestart;
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
    const Nanoseconds depth = nearest ? depths_.images[*nearest].first : 0;
    const Nanoseconds distance = std::llabs(depth - stamp);
    // After both streams have started again, no image of the previous pass will come.
    if (colors_.restartedSince(stamp) && depths_.restartedSince(stamp))
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

  void count(const ImageArrival& arrival, int* repeated, int* late) {
    unpaired_.unstamped += arrival.kind == ImageArrival::kUnstamped ? 1 : 0;
    *repeated += arrival.kind == ImageArrival::kRepeated ? 1 : 0;
    *late += arrival.kind == ImageArrival::kLate ? 1 : 0;
  }

  Nanoseconds tolerance_;
  std::size_t queue_size_;
  bool every_color_;
  Queue<ColorPtr> colors_;
  Queue<DepthPtr> depths_;
  InfoPtr info_{};
  int without_depth_ = kMostWithoutDepth;  ///< frames in a row; at the start none is allowed
  UnpairedImages unpaired_;
};

}  // namespace softbody
