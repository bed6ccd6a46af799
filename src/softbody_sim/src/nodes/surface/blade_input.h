#pragma once

#include <geometry_msgs/PolygonStamped.h>
#include <ros/ros.h>

#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "softbody_common/geometry/types.h"
#include "softbody_common/ros/stamp_gate.h"
#include "softbody_common/ros/transform_input.h"

namespace softbody {

/// Subscribes to the blade. A blade waits for the body's state of its stamp and is then transformed to the
/// state's frame.
class BladeInput {
 public:
  /// @param polygon #P by 3, in the frame of the last state [m].
  using Callback = std::function<void(const Points& polygon, const ros::Time& stamp)>;

  BladeInput(ros::NodeHandle node, Callback on_blade);

  /// A state of the body has come: passes on the last blade up to its stamp.
  void onState(const std_msgs::Header& header);
  /// Another body starts: forgets the last state and all waiting blades.
  void reset();

 private:
  struct Blade {
    std_msgs::Header header;
    Points corners;  ///< [m], in the header's frame
  };

  void onBlade(const geometry_msgs::PolygonStampedConstPtr& message);
  void add(Blade blade);
  void passOn(const Blade& blade);
  void skip(const ros::Time& stamp);
  std::optional<Points> toStateFrame(const Blade& blade);

  Callback on_blade_;
  StampGate stamps_;
  std::optional<std_msgs::Header> state_;       ///< of the last state
  std::deque<Blade> waiting_;                   ///< for their states
  int skipped_ = 0;                             ///< consecutive blades without a state of their time
  std::unique_ptr<TransformInput> transforms_;  ///< only if the blade is in another frame than the body
  ros::Subscriber subscriber_;
};

}  // namespace softbody
