#pragma once

#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <topic_tools/shape_shifter.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "softbody_recordings/ros/atomic_bag.h"

namespace softbody {

/// Records topics of any type into a bag, in the thread that calls it. Between two calls messages wait in
/// queues.
class TopicRecorder {
 public:
  /// @param topics absolute names. @throw std::runtime_error if the bag cannot be written.
  TopicRecorder(ros::NodeHandle node, const std::set<std::string>& topics, const std::filesystem::path& file);

  /// Writes what has come, or comes soon. @throw std::runtime_error if the bag cannot be written.
  void record();
  /// Closes the bag and gives it its name. @throw std::runtime_error if this fails.
  void finish();

  /// Per topic: number of messages.
  const std::map<std::string, std::uint64_t>& counts() const { return counts_; }
  std::uint64_t messages() const { return messages_; }
  std::uint64_t bytes() const { return bytes_; }  ///< of the messages

 private:
  using Event = ros::MessageEvent<topic_tools::ShapeShifter const>;

  void write(const std::string& topic, const Event& event);

  AtomicBag bag_;
  std::map<std::string, std::uint64_t> counts_;
  std::uint64_t messages_ = 0, bytes_ = 0;
  std::string fault_;  ///< why a message was not written; empty: none
  ros::CallbackQueue arrived_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace softbody
