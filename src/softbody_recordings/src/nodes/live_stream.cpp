#include "nodes/live_stream.h"

#include <boost/make_shared.hpp>
#include <stdexcept>

#include "softbody_common/ros/conversions.h"

namespace softbody::injection {
namespace {

constexpr std::uint32_t kImageQueue = 30;
constexpr double kWarningPeriod_s = 5.0;

}  // namespace

LiveStream::LiveStream(ros::NodeHandle* handle, const std::string& in, const std::string& out, bool is_depth,
                       const DeliveryFaults& deliveries, const ImageFaults& images)
    : handle_(*handle),
      topic_(handle->resolveName(in)),
      is_depth_(is_depth),
      deliveries_(deliveries),
      faults_(images),
      images_(topic_, is_depth, images) {
  publisher_ = handle->advertise<sensor_msgs::Image>(out, kImageQueue);
  subscriber_ =
      handle->subscribe(in, kImageQueue, &LiveStream::onImage, this, ros::TransportHints().tcpNoDelay());
}

void LiveStream::onImage(const sensor_msgs::ImageConstPtr& original) {
  ++counts_.in;
  if (timeline_.judge(toNanoseconds(original->header.stamp)).kind == StampVerdict::kJumpedBack) restart();
  const ImageDelivery delivery = deliveryOf(images_.count(), deliveries_);
  try {
    const auto image = boost::make_shared<sensor_msgs::Image>(images_.next(*original));
    image->header.stamp = toTime(toNanoseconds(image->header.stamp) + delivery.stamp_shift);
    const Held held{delivery, image};
    if (!delivery.after_next) send(held);
    if (overtaken_) send(*overtaken_);
    overtaken_.reset();
    if (delivery.after_next) overtaken_ = held;
  } catch (const std::invalid_argument& error) {
    ++counts_.refused;
    ROS_WARN_STREAM_THROTTLE(kWarningPeriod_s, error.what());
  }
}

void LiveStream::restart() {
  ROS_INFO_STREAM(topic_ << " starts again, so the faults start again too");
  images_ = FaultyImages(topic_, is_depth_, faults_);
  overtaken_.reset();
  late_.clear();
}

void LiveStream::send(const Held& held) {
  if (held.delivery.delay <= 0) return publish(held);
  const std::size_t number = next_timer_++;
  const auto fire = [this, held, number](const ros::TimerEvent&) {
    publish(held);
    late_.erase(number);
  };
  late_[number] = handle_.createTimer(toDuration(held.delivery.delay), fire, true);
}

void LiveStream::publish(const Held& held) {
  for (int i = 0; i < held.delivery.copies; ++i) publisher_.publish(held.image);
  counts_.out += held.delivery.copies;
}

}  // namespace softbody::injection
