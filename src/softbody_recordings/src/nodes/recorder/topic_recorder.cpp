#include "nodes/recorder/topic_recorder.h"

#include <algorithm>
#include <stdexcept>

namespace softbody {
namespace {

constexpr std::uint32_t kAll = 0;           // messages wait in memory while the disk is slow; none is lost
const ros::WallDuration kLongestWait(0.1);  // for the next message

}  // namespace

TopicRecorder::TopicRecorder(ros::NodeHandle node, const std::set<std::string>& topics,
                             const std::filesystem::path& file)
    : bag_(file, rosbag::compression::Uncompressed) {
  node.setCallbackQueue(&arrived_);
  for (const std::string& topic : topics) {
    counts_[topic] = 0;
    const boost::function<void(const Event&)> on_event = [this, topic](const Event& event) {
      write(topic, event);
    };
    subscribers_.push_back(node.subscribe<const Event&>(topic, kAll, on_event));
  }
}

void TopicRecorder::record() {
  arrived_.callAvailable(kLongestWait);
  if (!fault_.empty()) throw std::runtime_error(fault_);
}

/// The callback queue knows no exceptions, so a fault waits for record().
void TopicRecorder::write(const std::string& topic, const Event& event) try {
  if (!fault_.empty()) return;
  const topic_tools::ShapeShifter& message = *event.getConstMessage();
  // Before simulated time has begun, the time is 0, which a bag cannot hold.
  const ros::Time time = std::max(event.getReceiptTime(), ros::TIME_MIN);
  bag_.write(topic, time, message, event.getConnectionHeaderPtr());
  ++counts_[topic];
  ++messages_;
  bytes_ += message.size();
} catch (const std::exception& error) {
  fault_ = error.what();
}

void TopicRecorder::finish() {
  subscribers_.clear();
  bag_.finish();
}

}  // namespace softbody
