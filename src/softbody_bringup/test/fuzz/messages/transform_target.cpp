#include <tf2_msgs/TFMessage.h>

#include "fuzz/messages/target.h"
#include "softbody_common/ros/transform_input.h"

namespace softbody::fuzz {
namespace {

class TransformTarget : public Target {
 public:
  TransformTarget()
      : node_("tf", {}, [this](const auto&, const auto&) {
          const auto input = std::make_shared<TransformInput>();
          input_ = input.get();
          return input;
        }) {
    moving_ = add<tf2_msgs::TFMessage>(&node_, "/tf", 3, [this] { return robot(); });
    fixed_ = add<tf2_msgs::TFMessage>(&node_, "/tf_static", 1, [this] { return camera(); });
    // tf has a thread of its own, and drops what comes too fast.
    moving_->onSent([this](const auto&) { waitSometimes(); });
    fixed_->onSent([this](const auto&) { waitSometimes(); });
  }

  std::string check() override {
    constexpr int kGood = 100;
    for (int i = 0; i < kGood; ++i) {
      LoneRos::instance().advance(0.033);
      fixed_->send(camera());
      moving_->send(robot());
    }
    const ros::Time stamp = LoneRos::instance().now();
    const auto known = [&] { return input_->buffer().canTransform("base", "optical", stamp); };
    if (!node_.processUntil(known)) return "tf does not know the good frames";
    const auto transform = input_->buffer().lookupTransform("base", "optical", stamp).transform;
    const bool right = transform.translation.x == 1.0 && transform.translation.y == 2.0;
    return right ? "" : "tf has another transform than the good one";
  }

 private:
  static geometry_msgs::TransformStamped transform(const char* parent, const char* child) {
    geometry_msgs::TransformStamped transform;
    transform.header.frame_id = parent;
    transform.header.stamp = LoneRos::instance().now();
    transform.child_frame_id = child;
    transform.transform.rotation.w = 1.0;
    return transform;
  }

  tf2_msgs::TFMessage robot() {
    tf2_msgs::TFMessage message;
    message.transforms = {transform("base", "arm"), transform("arm", "hand")};
    message.transforms[0].transform.translation.x = 1.0;
    return message;
  }

  tf2_msgs::TFMessage camera() {
    tf2_msgs::TFMessage message;
    message.transforms = {transform("hand", "optical")};
    message.transforms[0].transform.translation.y = 2.0;
    return message;
  }

  void waitSometimes() {
    constexpr int kBetween = 50;  // the queue holds 100
    if (++sent_ % kBetween == 0) ros::WallDuration(0.002).sleep();
  }

  int sent_ = 0;
  const TransformInput* input_ = nullptr;
  DrivenNode node_;
  TopicInput<tf2_msgs::TFMessage>*moving_, *fixed_;
};

}  // namespace

std::unique_ptr<Target> makeTransformTarget() { return std::make_unique<TransformTarget>(); }

}  // namespace softbody::fuzz
