#pragma once

#include <rosbag/bag.h>

#include <deque>
#include <string>
#include <vector>

#include "softbody_common/cutting/cut.h"

namespace softbody {

/// Recorded cuts, to be repeated at the same stamps.
class CutJournal {
 public:
  CutJournal() = default;
  /// @throw std::invalid_argument if the topic is missing, or a cut is malformed.
  CutJournal(const rosbag::Bag& bag, const std::string& topic);

  /// Removes and returns the cuts up to a stamp.
  std::vector<Cut> takeUntil(Nanoseconds stamp);
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    Nanoseconds stamp = 0;
    Cut cut;
  };
  std::deque<Entry> entries_;
};

}  // namespace softbody
