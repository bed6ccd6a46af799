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

/// What makes a pair of a colour and a depth image.
struct PairingConfig {
  bool exact = false;                  ///< stamps must be equal
  Nanoseconds tolerance = 15'000'000;  ///< largest difference of stamps otherwise
  int queue_size = 10;                 ///< images of a stream that wait for their frame at most
  bool every_color = false;            ///< no colour image is left out, with depth or without: for evaluation
};

/// @throw std::invalid_argument with key, value and range.
PairingConfig readPairingConfig(Parameters& parameters);

/// What became of an image that was added.
struct ImageArrival {
  enum Kind {
    kAccepted,
    kRestarted,  ///< accepted; its stamp is a second or more before the last: its stream starts again
    kUnstamped,  ///< dropped: its stamp is not above 0
    kRepeated,   ///< dropped: it has the stamp of the image before
    kLate        ///< dropped: its stamp is before the last one's
  };
  Kind kind;
  Nanoseconds gap = 0;  ///< from the last image's stamp to its own

  bool accepted() const { return kind == kAccepted || kind == kRestarted; }
};

/// Images that are in no frame.
struct UnpairedImages {
  int unstamped = 0, colors_repeated = 0, depths_repeated = 0, colors_late = 0, depths_late = 0;
  int colors_alone = 0;  ///< their depth image did not come, and could not be done without
  int depths_alone = 0;  ///< no colour image is near to them
};

/// Pairs each colour image with the depth image nearest in time. Live graph, replay and evaluation pair by
/// this rule alone. It knows stamps and the order in which each stream's images arrive, and no clock, so that
/// a recording gives the frames that the live graph had.
///
/// A pair is complete as soon as no nearer image can come: a stream goes on in the order of its stamps, and
/// its next image follows after half of the shortest gap seen, at the least. A pair with equal stamps is
/// complete at once. A colour image without a depth image makes a frame too, but only
/// kMostWithoutDepth in a row: more are a depth stream that stopped or has another clock.
/// @tparam ColorPtr, DepthPtr, InfoPtr what stands for the images and the camera's description; null: none.
template <typename ColorPtr, typename DepthPtr, typename InfoPtr>
class FramePairer {
 public:
  struct Frame {
    Nanoseconds stamp;  ///< of the colour image
    ColorPtr color;
    DepthPtr depth;  ///< null: no depth image came within the tolerance
    InfoPtr info;    ///< the newest that had arrived
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
  /// @param finish no more images will come: pairs that a nearer image could still have split are complete.
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
  /// At 30 images a second: depth that is silent for longer is a fault that must be named, not bridged.
  static constexpr int kMostWithoutDepth = 30;
  /// A stamp that goes back by this much is a recording that starts again; less is a late image.
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

    /// Index of the image nearest in time, the first of equals; none where the queue is empty.
    std::optional<std::size_t> nearestTo(Nanoseconds stamp) const {
      const auto nearer = [stamp](const auto& a, const auto& b) {
        return std::llabs(a.first - stamp) < std::llabs(b.first - stamp);
      };
      const auto nearest = std::min_element(images.begin(), images.end(), nearer);
      if (nearest == images.end()) return std::nullopt;
      return static_cast<std::size_t>(nearest - images.begin());
    }

    /// How much later than a stamp the next image is at the least; below 0 where that is not known.
    /// @param most of the gap that is relied on.
    Nanoseconds nextIsLaterBy(Nanoseconds stamp, Nanoseconds most) const {
      constexpr Nanoseconds kUnknown = std::numeric_limits<Nanoseconds>::max();
      // A stream that is far ahead is still in the pass of a recording that the other has left.
      if (newest == 0 || newest - stamp >= kRestart) return -kRestart;
      const Nanoseconds gap = shortest_gap == kUnknown ? 0 : std::min(shortest_gap / 2, most);
      const Nanoseconds least = std::max<Nanoseconds>(1, gap);
      return newest - stamp + least;
    }
  };

  /// The depth image of the first colour image.
  struct Partner {
    std::optional<std::size_t> depth;  ///< none: no depth image belongs to it, of those that have come
    bool certain = false;              ///< images to come cannot change it
  };

  Partner partnerOf(Nanoseconds stamp) const {
    const std::optional<std::size_t> nearest = depths_.nearestTo(stamp);
    const Nanoseconds depth = nearest ? depths_.images[*nearest].first : 0;
    const Nanoseconds distance = std::llabs(depth - stamp);
    // After both streams have started again no image of the pass before will come.
    if (colors_.restartedSince(stamp) && depths_.restartedSince(stamp))
      return {distance <= tolerance_ ? nearest : std::nullopt, true};
    if (!nearest || distance > tolerance_)
      return {std::nullopt, depths_.nextIsLaterBy(stamp, tolerance_) > tolerance_};
    // A depth image that fits a later colour image better is that one's: one that was dropped must not shift
    // all pairs.
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
  int without_depth_ = kMostWithoutDepth;  ///< colour images in a row; the first frame has depth
  UnpairedImages unpaired_;
};

}  // namespace softbody
