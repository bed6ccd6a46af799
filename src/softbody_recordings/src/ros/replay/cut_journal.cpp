#include "ros/replay/cut_journal.h"

#include <fmt/format.h>
#include <rosbag/view.h>

#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/ros/cut_messages.h"

namespace softbody {

CutJournal::CutJournal(const rosbag::Bag& bag, const std::string& topic) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  if (view.size() == 0)
    throw std::invalid_argument(
        fmt::format("{} has no cuts on {}; record this topic while you cut", bag.getFileName(), topic));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<softbody_msgs::Cut>();
    if (!message) {
      throw std::invalid_argument(fmt::format("{} on {} is of type {} instead of softbody_msgs/Cut",
                                              bag.getFileName(), topic, instance.getDataType()));
    }
    Entry entry{toNanoseconds(message->header.stamp), fromMessage(*message)};
    // A cut that was undone or repeated is replaced by the next cut with its revision.
    while (!entries_.empty() && entries_.back().cut.revision >= entry.cut.revision) entries_.pop_back();
    entries_.push_back(std::move(entry));
  }
}

std::vector<Cut> CutJournal::takeUntil(Nanoseconds stamp) {
  std::vector<Cut> due;
  for (; !entries_.empty() && entries_.front().stamp <= stamp; entries_.pop_front())
    due.push_back(std::move(entries_.front().cut));
  return due;
}

}  // namespace softbody
