#pragma once

#include <optional>
#include <string>

#include "softbody_common/time/time.h"

namespace softbody {

/// What a stamp means for the stream that it comes in.
struct StampVerdict {
  enum Kind {
    kInOrder,
    kMoved,       ///< accepted: time has leapt ahead, or back to where it was before such a leap
    kJumpedBack,  ///< accepted: the stream starts again, for example in a bag that loops
    kUnstamped,   ///< refused: the stamp is not above 0
    kRepeated,    ///< refused: the stamp is that of the last message
    kLate,        ///< refused: the stamp is up to a second before the last one
    kOutlier      ///< refused: the stamp is farther from the last one, and alone there
  };
  Kind kind = kInOrder;
  Nanoseconds gap = 0;  ///< from the last accepted stamp
  int in_a_row = 0;     ///< of an outlier: 1 for the first stamp there, 2 for the next

  bool accepted() const { return kind <= kJumpedBack; }
  /// Accepted, or one more message of the last accepted stamp.
  bool acceptedOrSame() const { return accepted() || (kind == kRepeated && gap == 0); }
  /// Accepted, and time went back.
  bool wentBack() const { return accepted() && gap < 0; }
};

/// Why a stamp is refused, as in "its stamp is 2.000 s after the last one and alone there".
std::string whyRefused(const StampVerdict& verdict);

/// A stamp that was refused.
struct RefusedStamp {
  Nanoseconds stamp = 0;
  StampVerdict verdict;
};

/// Decides which refused stamps of one stream deserve a warning. An odd stamp deserves it when the stream
/// goes on without it. The first stamps of a recording that starts again do not: they come before the clock.
class RefusedStamps {
 public:
  /// Call it for every message. @return the stamp to warn of, this one or the one before.
  std::optional<RefusedStamp> note(Nanoseconds stamp, const StampVerdict& verdict);

 private:
  std::optional<RefusedStamp> odd_;
};

/// Judges the stamps of one stream. A single stamp far ahead or far back is an outlier and changes nothing.
/// Time has jumped after kStays consecutive stamps in the new time, or at once if the receiver's clock has
/// made the same jump.
class Timeline {
 public:
  /// Within this distance of the last stamp nothing has jumped. A longer pause than this in the stream is in
  /// order if the clock shows it, too.
  static constexpr Nanoseconds kLeap = 1'000'000'000;
  static constexpr int kStays = 3;

  /// @param now time of arrival on the receiver's clock, of any epoch; not above 0: the clock has not
  /// started. Without it only stamps count, and the same stamps always give the same verdicts.
  StampVerdict judge(Nanoseconds stamp, std::optional<Nanoseconds> now = std::nullopt);

  /// The last accepted stamp; 0: none.
  Nanoseconds last() const { return last_; }
  /// How often the stream has started again.
  int pass() const { return pass_; }

 private:
  /// A stream slower than this counts as single messages.
  static constexpr Nanoseconds kSlowest = 3'600'000'000'000;

  /// Consecutive stamps that follow each other away from the last accepted one.
  struct Run {
    int count = 0;
    Nanoseconds first = 0, last = 0, step = 0;  ///< the latter: between the last two
  };
  void extendRun(Nanoseconds stamp);
  StampVerdict accept(StampVerdict::Kind kind, Nanoseconds stamp, std::optional<Nanoseconds> now);
  void updateLead(Nanoseconds lead, Nanoseconds elapsed);

  Nanoseconds last_ = 0;
  Nanoseconds before_leap_ = 0, after_leap_ = 0;  ///< stamps around the last leap ahead; 0: none
  Nanoseconds lead_ = 0;  ///< greatest of late, of a stamp before its arrival; usually negative
  Nanoseconds pace_ = 0;  ///< time between the messages of a slow stream; 0: at most kLeap
  std::optional<Nanoseconds> accepted_at_;
  Run run_;
  int pass_ = 0;
};

}  // namespace softbody
