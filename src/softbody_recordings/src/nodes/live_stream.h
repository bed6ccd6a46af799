#pragma once

#include <ros/ros.h>
#include <sensor_msgs/Image.h>

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "ros/injection/faulty_images.h"
#include "softbody_common/time/timeline.h"
#include "softbody_recordings/injection/deliveries.h"

namespace softbody::injection {

/// One stream of live images: publishes the images with their faults.
class LiveStream {
 public:
  /// Images that came, that were published, and that could not be used.
  struct Counts {
    int in = 0, out = 0, refused = 0;
  };

  LiveStream(ros::NodeHandle* handle, const std::string& in, const std::string& out, bool is_depth,
             const DeliveryFaults& deliveries, const ImageFaults& images);

  const std::string& topic() const { return topic_; }
  /// Since the last call.
  Counts takeCounts() { return std::exchange(counts_, {}); }

 private:
  struct Held {
    ImageDelivery delivery;
    sensor_msgs::ImageConstPtr image;
  };

  void onImage(const sensor_msgs::ImageConstPtr& original);
  void restart();
  /// Publishes now, or after the image's delay.
  void send(const Held& held);
  void publish(const Held& held);

  ros::NodeHandle handle_;
  std::string topic_;
  bool is_depth_;
  DeliveryFaults deliveries_;
  ImageFaults faults_;
  FaultyImages images_;
  Timeline timeline_;
  std::optional<Held> overtaken_;           ///< waits until the next image was sent
  std::map<std::size_t, ros::Timer> late_;  ///< timers of delayed images, by number
  std::size_t next_timer_ = 0;
  Counts counts_;
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
};

}  // namespace softbody::injection
