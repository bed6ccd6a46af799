#pragma once

#include <rosbag/bag.h>

#include <deque>
#include <string>
#include <vector>

#include "softbody_common/cut.h"

namespace softbody {

/// Recorded cuts, to be made again at the same instants.
class CutJournal {
 public:
  CutJournal() = default;
  /// @throw std::invalid_argument if the bag has no such topic, or a cut is malformed.
  CutJournal(const rosbag::Bag& bag, const std::string& topic);

  /// The cuts up to an instant that have not been taken yet.
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
