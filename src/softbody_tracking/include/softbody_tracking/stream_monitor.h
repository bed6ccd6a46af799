#pragma once

#include <array>
#include <deque>
#include <string>

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
  explicit StreamMonitor(Nanoseconds tolerance) : tolerance_(tolerance) {}

  void arrived(Stream stream, Nanoseconds stamp);
  /// A message without a stamp, which cannot be used.
  void unstamped(Stream stream) { unstamped_[static_cast<std::size_t>(stream)] = true; }
  /// A synchronised set that could not be used, and why.
  void refused(const std::string& why) { refusal_ = why; }
  /// A complete frame: everything before it is forgotten.
  void completed();

  /// Why there was no frame since the last one, in a sentence.
  std::string complaint(const StreamTopics& topics) const;

 private:
  std::array<std::deque<Nanoseconds>, 3> stamps_;
  std::array<bool, 3> unstamped_{};
  std::string refusal_;
  Nanoseconds tolerance_;
};

}  // namespace softbody
