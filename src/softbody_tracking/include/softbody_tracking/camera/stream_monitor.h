#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "softbody_common/types.h"

namespace softbody {

enum class Stream { kColor = 0, kColorInfo = 1, kDepth = 2 };

/// A stream's topic as the user sees it.
struct StreamTopic {
  std::string name;  ///< resolved
  int publishers = 0;
};
using StreamTopics = std::array<StreamTopic, 3>;  ///< in the order of Stream

/// Remembers what arrived since the last complete frame, to say why none came.
class StreamMonitor {
 public:
  /// @param tolerance largest difference of the stamps of colour and depth; 0: they must be equal.
  /// @param silence in which a stream that goes on has a message.
  StreamMonitor(Nanoseconds tolerance, Nanoseconds silence) : tolerance_(tolerance), silence_(silence) {}

  /// @param now by the clock that complaint() goes by.
  void arrived(Stream stream, Nanoseconds stamp, Nanoseconds now);
  /// A message without a stamp, which cannot be used.
  void unstamped(Stream stream);
  /// A synchronised set that could not be used, and why.
  void refused(const std::string& why) { refusal_ = why; }
  /// A complete frame: everything before it is forgotten.
  void completed();

  /// Whether it ever sent a message, with a stamp or without.
  bool hasCome(Stream stream) const { return came_[static_cast<std::size_t>(stream)]; }
  /// Why there was no frame since the last one, in a sentence.
  std::string complaint(const StreamTopics& topics, Nanoseconds now) const;

 private:
  struct Arrival {
    Nanoseconds stamp, time;
  };
  std::vector<Nanoseconds> lately(Stream stream, Nanoseconds now) const;
  bool isSilent(Stream stream, Nanoseconds now) const;

  std::array<std::deque<Arrival>, 3> arrivals_;
  std::array<bool, 3> unstamped_{}, came_{};
  std::string refusal_;
  Nanoseconds tolerance_, silence_;
};

}  // namespace softbody
