#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/image_encodings.h>

#include <filesystem>
#include <stdexcept>

#include "softbody_bringup/injection/injector.h"
#include "softbody_common/conversions.h"

namespace softbody::injection {
namespace {

namespace encodings = sensor_msgs::image_encodings;

/// The message's pixels, to be changed in place. @throw std::invalid_argument if they are not as needed.
cv::Mat pixels(const std::string& topic, int type, sensor_msgs::Image* image) {
  const std::size_t row = image->width * CV_ELEM_SIZE(type);
  if (image->step < row || image->data.size() < static_cast<std::size_t>(image->step) * image->height)
    throw std::invalid_argument(fmt::format("{}: an image's bytes do not fit its size", topic));
  return cv::Mat(static_cast<int>(image->height), static_cast<int>(image->width), type, image->data.data(),
                 image->step);
}

/// One stream: when its images arrive, and how they look.
class Stream {
 public:
  Stream(std::string topic, bool is_depth, const rosbag::Bag& bag, const InjectorOptions& options)
      : topic_(std::move(topic)), is_depth_(is_depth), faults_(options.images) {
    rosbag::View view(bag, rosbag::TopicQuery(topic_));
    std::vector<Nanoseconds> received;
    for (const rosbag::MessageInstance& instance : view)
      received.push_back(toNanoseconds(instance.getTime()));
    if (received.empty())
      throw std::invalid_argument(fmt::format("{}: there is nothing on {}", options.input, topic_));
    const bool wanted = is_depth ? options.in_depth : options.in_color;
    deliveries_ = planDeliveries(received, wanted ? options.deliveries : DeliveryFaults());
  }

  /// @param first stamp of the recording's first image.
  void write(const rosbag::MessageInstance& instance, Nanoseconds first, rosbag::Bag* output) {
    const auto original = instance.instantiate<sensor_msgs::Image>();
    if (!original)
      throw std::invalid_argument(
          fmt::format("{} is of type {} instead of sensor_msgs/Image", topic_, instance.getDataType()));
    const double time = 1e-9 * static_cast<double>(toNanoseconds(original->header.stamp) - first);
    sensor_msgs::Image changed = *original;
    spoil(time, &changed);
    for (; next_ < deliveries_.size() && deliveries_[next_].image == read_; ++next_) {
      changed.header.stamp = toTime(toNanoseconds(original->header.stamp) + deliveries_[next_].stamp_shift);
      output->write(topic_, toTime(deliveries_[next_].received), changed, instance.getConnectionHeader());
    }
    ++read_;
  }

  const std::string& topic() const { return topic_; }
  std::size_t read() const { return read_; }
  std::size_t written() const { return deliveries_.size(); }

 private:
  void spoil(double time, sensor_msgs::Image* image) const {
    const bool occluded = occluderPresent(time, faults_);
    if (!is_depth_ && occluded) {
      const bool rgb = image->encoding == encodings::RGB8;
      if (!rgb && image->encoding != encodings::BGR8) refuse(*image, "rgb8 or bgr8");
      cv::Mat3b color = pixels(topic_, CV_8UC3, image);
      occludeColor(faults_, rgb, &color);
    } else if (is_depth_ && (occluded || faults_.hole_share > 0.0)) {
      const bool millimetres =
          image->encoding == encodings::TYPE_16UC1 || image->encoding == encodings::MONO16;
      if (!millimetres && image->encoding != encodings::TYPE_32FC1) refuse(*image, "16UC1 or 32FC1");
      cv::Mat depth = pixels(topic_, millimetres ? CV_16UC1 : CV_32FC1, image);
      if (occluded) occludeDepth(faults_, &depth);
      punchHoles(faults_, read_, &depth);
    }
  }

  [[noreturn]] void refuse(const sensor_msgs::Image& image, const char* needed) const {
    throw std::invalid_argument(
        fmt::format("{} has encoding {}; {} is needed to change it", topic_, image.encoding, needed));
  }

  std::string topic_;
  bool is_depth_;
  const ImageFaults& faults_;
  std::vector<Delivery> deliveries_;
  std::size_t read_ = 0, next_ = 0;
};

Nanoseconds firstStamp(const rosbag::Bag& bag, const std::string& topic) {
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  const auto image = view.begin()->instantiate<sensor_msgs::Image>();
  return image ? toNanoseconds(image->header.stamp) : 0;
}

/// Removes the unfinished file unless it was closed and renamed.
class OutputBag {
 public:
  explicit OutputBag(const std::string& path) : path_(path), temporary_(path + ".part") {
    bag.open(temporary_.string(), rosbag::bagmode::Write);
    bag.setCompression(rosbag::compression::LZ4);
  }
  ~OutputBag() {
    if (!bag.isOpen()) return;
    bag.close();
    std::error_code ignored;
    std::filesystem::remove(temporary_, ignored);
  }
  OutputBag(const OutputBag&) = delete;
  OutputBag& operator=(const OutputBag&) = delete;
  void finish() {
    bag.close();
    std::filesystem::rename(temporary_, path_);
  }

  rosbag::Bag bag;

 private:
  std::filesystem::path path_, temporary_;
};

}  // namespace

InjectionReport inject(const InjectorOptions& options, const std::function<void(double)>& progress) {
  std::error_code ignored;
  if (std::filesystem::equivalent(options.input, options.output, ignored))
    throw std::invalid_argument(fmt::format("{} is the input; name another output", options.output));
  const rosbag::Bag input(options.input, rosbag::bagmode::Read);
  Stream color(options.camera + "/color/image_raw", false, input, options);
  Stream depth(options.camera + "/aligned_depth_to_color/image_raw", true, input, options);
  const Nanoseconds first = firstStamp(input, color.topic());
  OutputBag output(options.output);
  rosbag::View view(input);
  InjectionReport report;
  double count = 0.0;
  for (const rosbag::MessageInstance& instance : view) {
    const std::string topic = instance.getTopic();
    if (topic == color.topic()) {
      color.write(instance, first, &output.bag);
    } else if (topic == depth.topic()) {
      depth.write(instance, first, &output.bag);
    } else {
      output.bag.write(topic, instance.getTime(), instance, instance.getConnectionHeader());
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
}

}  // namespace softbody::injection
