#pragma once

#include <array>
#include <deque>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"

namespace softbody {

enum class Stream { kColor = 0, kColorInfo = 1, kDepth = 2 };

/// The topic of a stream.
struct StreamTopic {
  std::string name;  ///< resolved name
  int publishers = 0;
  std::string base = {};  ///< the name without that of a transport
};
using StreamTopics = std::array<StreamTopic, 3>;  ///< in the order of Stream

/// Remembers the messages since the last frame, to explain why no further frame came.
class StreamMonitor {
 public:
  /// @param tolerance largest difference of the stamps of colour and depth; 0: they must be equal.
  /// @param timeout a stream without a message for this long is silent.
  StreamMonitor(Nanoseconds tolerance, Nanoseconds timeout) : tolerance_(tolerance), timeout_(timeout) {}

  /// A message arrived. @param now of the clock that diagnosis() uses.
  void noteArrival(Stream stream, Nanoseconds stamp, Nanoseconds now);
  /// A message without a stamp arrived. It cannot be used.
  void noteUnstamped(Stream stream);
  /// The messages of a frame could not be used.
  void noteRefusal(const std::string& why) { refusal_ = why; }
  /// A frame is complete. Forgets all messages before it.
  void noteFrame();

  /// Whether the stream has ever had a message, with a stamp or without.
  bool hasArrived(Stream stream) const { return ever_arrived_[static_cast<std::size_t>(stream)]; }
  /// A stream without a usable message in the timeout.
  struct Silent {
    Stream stream;
    bool unstamped;  ///< messages came, but without a stamp
  };
  std::vector<Silent> silentStreams(Nanoseconds now) const;
  /// One sentence that explains why no frame came since the last one.
  std::string diagnosis(const StreamTopics& topics, Nanoseconds now) const;

 private:
  struct Arrival {
    Nanoseconds stamp, time;
  };
  std::vector<Nanoseconds> recentStamps(Stream stream, Nanoseconds now) const;
  bool isSilent(Stream stream, Nanoseconds now) const;

  std::array<std::deque<Arrival>, 3> arrivals_;
  std::array<bool, 3> unstamped_{}, ever_arrived_{};
  std::string refusal_;
  Nanoseconds tolerance_, timeout_;
};

}  // namespace softbody
