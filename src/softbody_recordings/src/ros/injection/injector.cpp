#include "ros/injection/injector.h"

#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>

#include <filesystem>
#include <stdexcept>

#include "ros/injection/faulty_images.h"
#include "softbody_common/protocol/camera_topics.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_recordings/ros/atomic_bag.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/recorded_images.h"

namespace softbody::injection {
namespace {

/// One stream with its delivery and image faults.
class ImageStream {
 public:
  ImageStream(const std::string& topic, bool is_depth, const rosbag::Bag& bag, const InjectorOptions& options)
      : bag_(bag), topic_(topic), images_(topic, is_depth, options.images) {
    rosbag::View view(bag, rosbag::TopicQuery(topic_));
    std::vector<Nanoseconds> received;
    for (const rosbag::MessageInstance& instance : view)
      received.push_back(toNanoseconds(instance.getTime()));
    if (received.empty())
      throw std::invalid_argument(
          fmt::format("{}: there is no message on {}; rosbag info lists its topics", options.input, topic_));
    const bool wanted = is_depth ? options.in_depth : options.in_color;
    arrivals_ = planArrivals(received, wanted ? options.deliveries : DeliveryFaults());
  }

  void write(const rosbag::MessageInstance& instance, AtomicBag* output) {
    const sensor_msgs::ImageConstPtr original = recordedImage(instance, bag_);
    const std::size_t number = images_.count();
    sensor_msgs::Image changed = images_.next(*original);
    for (; next_ < arrivals_.size() && arrivals_[next_].image == number; ++next_) {
      changed.header.stamp = toTime(toNanoseconds(original->header.stamp) + arrivals_[next_].stamp_shift);
      const ros::Time received = toTime(arrivals_[next_].received);
      if (instance.getDataType() == ros::message_traits::datatype(changed))
        output->write(topic_, received, changed, instance.getConnectionHeader());
      else  // compressed images become raw ones
        output->write(topic_.substr(0, topic_.rfind('/')), received, changed);
    }
  }

  const std::string& topic() const { return topic_; }
  std::size_t read() const { return images_.count(); }
  std::size_t written() const { return arrivals_.size(); }

 private:
  const rosbag::Bag& bag_;
  std::string topic_;
  FaultyImages images_;
  std::vector<Arrival> arrivals_;
  std::size_t next_ = 0;
};

}  // namespace

InjectionReport inject(const InjectorOptions& options, const std::function<void(double)>& progress) try {
  std::error_code ignored;
  if (std::filesystem::equivalent(options.input, options.output, ignored))
    throw std::invalid_argument(fmt::format("{} is the input; choose another output", options.output));
  const rosbag::Bag input = openBag(options.input);
  const CameraTopics topics = recordedTopics(input, options.camera);
  ImageStream color(topics.color, false, input, options);
  ImageStream depth(topics.depth, true, input, options);
  AtomicBag output(options.output);
  rosbag::View view(input);
  InjectionReport report;
  double count = 0.0;
  for (const rosbag::MessageInstance& instance : view) {
    const std::string topic = instance.getTopic();
    if (topic == color.topic()) {
      color.write(instance, &output);
    } else if (topic == depth.topic()) {
      depth.write(instance, &output);
    } else {
      output.write(topic, instance.getTime(), instance, instance.getConnectionHeader());
      ++report.copied;
    }
    progress(++count / static_cast<double>(view.size()));
  }
  output.finish();
  report.color_read = color.read();
  report.color_written = color.written();
  report.depth_read = depth.read();
  report.depth_written = depth.written();
  return report;
} catch (const rosbag::BagException& error) {
  throw damagedBag(options.input, error);
}

}  // namespace softbody::injection
