#pragma once

#include <message_filters/sync_policies/approximate_time.h>
#include <message_filters/sync_policies/exact_time.h>
#include <message_filters/synchronizer.h>
#include <sensor_msgs/Image.h>

#include <functional>
#include <memory>

namespace softbody {

/// Pairs colour and depth images by their stamps.
class ImagePairer {
 public:
  using Callback = std::function<void(const sensor_msgs::ImageConstPtr&, const sensor_msgs::ImageConstPtr&)>;
  virtual ~ImagePairer() = default;
  virtual void addColor(const sensor_msgs::ImageConstPtr& image) = 0;
  virtual void addDepth(const sensor_msgs::ImageConstPtr& image) = 0;
};

template <typename Policy>
class PolicyPairer : public ImagePairer {
 public:
  PolicyPairer(const Policy& policy, Callback callback)
      : synchronizer_(policy), callback_(std::move(callback)) {
    synchronizer_.registerCallback(&PolicyPairer::onPair, this);
  }
  void addColor(const sensor_msgs::ImageConstPtr& image) override {
    synchronizer_.template add<0>(Event(image));
  }
  void addDepth(const sensor_msgs::ImageConstPtr& image) override {
    synchronizer_.template add<1>(Event(image));
  }

 private:
  using Event = ros::MessageEvent<const sensor_msgs::Image>;
  void onPair(const sensor_msgs::ImageConstPtr& color, const sensor_msgs::ImageConstPtr& depth) {
    callback_(color, depth);
  }
  message_filters::Synchronizer<Policy> synchronizer_;
  Callback callback_;
};

inline std::unique_ptr<ImagePairer> makeExactPairer(int queue_size, ImagePairer::Callback callback) {
  using Policy = message_filters::sync_policies::ExactTime<sensor_msgs::Image, sensor_msgs::Image>;
  return std::make_unique<PolicyPairer<Policy>>(Policy(queue_size), std::move(callback));
}

inline std::unique_ptr<ImagePairer> makeApproximatePairer(int queue_size, double tolerance_s,
                                                          ImagePairer::Callback callback) {
  using Policy = message_filters::sync_policies::ApproximateTime<sensor_msgs::Image, sensor_msgs::Image>;
  Policy policy(queue_size);
  policy.setMaxIntervalDuration(ros::Duration(tolerance_s));
  return std::make_unique<PolicyPairer<Policy>>(policy, std::move(callback));
}

}  // namespace softbody
