#pragma once

#include <deque>

#include "softbody_common/geometry/types.h"

namespace softbody {

/// Measures how far colour and depth images are apart in time, whether they make frames or not. It looks at
/// the images of the last seconds.
class SyncMonitor {
 public:
  /// @param tolerance largest difference of the stamps of a pair.
  explicit SyncMonitor(Nanoseconds tolerance) : tolerance_(tolerance) {}

  /// An image arrived. @param now of the clock that offsets() uses.
  void noteColor(Nanoseconds stamp, Nanoseconds now) { note(&colors_, stamp, now); }
  void noteDepth(Nanoseconds stamp, Nanoseconds now) { note(&depths_, stamp, now); }

  /// Differences of each colour image's stamp from the nearest stamp of depth.
  struct Offsets {
    int colors = 0;  ///< colour images that could be compared; 0: no offset is known
    int beyond = 0;  ///< of them, those without a depth image in the tolerance
    double mean_s = 0.0, worst_s = 0.0;
  };
  /// Of the last seconds. A colour image that is newer than all depth images is not compared yet.
  Offsets offsets(Nanoseconds now) const;

 private:
  struct Arrival {
    Nanoseconds stamp, time;
  };

  static void note(std::deque<Arrival>* arrivals, Nanoseconds stamp, Nanoseconds now);

  Nanoseconds tolerance_;
  std::deque<Arrival> colors_, depths_;
};

}  // namespace softbody
