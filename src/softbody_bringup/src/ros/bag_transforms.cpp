#include "softbody_bringup/bag_transforms.h"

#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <iterator>

#include "softbody_bringup/input_bag.h"

namespace softbody {
namespace {

constexpr double kWholeBag_s = 1e6;
constexpr double kLongestGap_s =
    0.5;  // an arm that speeds up leaves a straight way of so long by centimetres

}  // namespace

BagTransforms::BagTransforms(const std::vector<std::string>& paths) : buffer_(ros::Duration(kWholeBag_s)) {
  for (const std::string& path : paths) addBag(path);
}

void BagTransforms::addBag(const std::string& path) {
  const rosbag::Bag bag = openBag(path);
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{"/tf", "/tf_static"}));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<tf2_msgs::TFMessage>();
    if (!message) continue;
    const bool is_static = instance.getTopic() == "/tf_static";
    for (const geometry_msgs::TransformStamped& transform : message->transforms) {
      buffer_.setTransform(transform, path, is_static);
      if (!is_static) stamps_[transform.child_frame_id].insert(transform.header.stamp);
    }
  }
}

/// Whether the way from a frame up to the root of its tree leads to `top`, without a gap up to there.
bool BagTransforms::climbsTo(const std::string& top, std::string frame, const ros::Time& stamp) const {
  for (std::string parent; frame != top && buffer_._getParent(frame, stamp, parent); frame = parent) {
    const auto moved = stamps_.find(frame);
    if (moved == stamps_.end()) continue;
    const auto after = moved->second.lower_bound(stamp);
    if (after == moved->second.end() || after == moved->second.begin() || *after == stamp) continue;
    const double gap_s = (*after - *std::prev(after)).toSec();
    if (gap_s <= kLongestGap_s) continue;
    throw tf2::ExtrapolationException(fmt::format("/tf says nothing of {} for {:.3f} s", frame, gap_s));
  }
  return frame == top;
}

Eigen::Isometry3d BagTransforms::at(const std::string& target, const std::string& source,
                                    const ros::Time& stamp) const {
  const auto transform = buffer_.lookupTransform(target, source, stamp);
  if (!climbsTo(target, source, stamp)) climbsTo(source, target, stamp);
  return tf2::transformToEigen(transform);
}

}  // namespace softbody
