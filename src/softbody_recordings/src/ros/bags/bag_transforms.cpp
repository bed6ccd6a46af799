#include "softbody_recordings/ros/bag_transforms.h"

#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "softbody_common/ros/time.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_tracking/ros/conversions.h"

namespace softbody {
namespace {

constexpr double kWholeBag_s = 1e6;
// In this time an accelerating arm leaves the straight line between two samples by centimetres.
constexpr double kLongestGap_s = 0.5;
constexpr double kUnitTolerance = 1e-2;  // tf2's own, of the squared length
constexpr double kMoved_m = 1e-4, kTurned_rad = 1e-4;

/// Whether tf2 refuses the transform, or a value is infinite. One such sample would spoil its neighbours.
bool isUnusable(const geometry_msgs::TransformStamped& transform) {
  const std::string parent = withoutSlash(transform.header.frame_id),
                    child = withoutSlash(transform.child_frame_id);
  const geometry_msgs::Vector3& t = transform.transform.translation;
  const geometry_msgs::Quaternion& q = transform.transform.rotation;
  const Eigen::Vector4d rotation(q.x, q.y, q.z, q.w);
  return parent.empty() || child.empty() || parent == child || !Eigen::Vector3d(t.x, t.y, t.z).allFinite() ||
         !(std::abs(rotation.squaredNorm() - 1.0) < kUnitTolerance);
}

bool differ(const geometry_msgs::Transform& a, const geometry_msgs::Transform& b) {
  const Eigen::Isometry3d from = tf2::transformToEigen(a), to = tf2::transformToEigen(b);
  return (to.translation() - from.translation()).norm() > kMoved_m ||
         Eigen::Quaterniond(from.linear()).angularDistance(Eigen::Quaterniond(to.linear())) > kTurned_rad;
}

template <typename Samples>
auto firstFrom(const Samples& samples, const ros::Time& stamp) {
  return std::lower_bound(samples.begin(), samples.end(), stamp,
                          [](const auto& sample, const ros::Time& time) { return sample.stamp < time; });
}

}  // namespace

BagTransforms::BagTransforms(const std::vector<std::string>& paths) {
  // The last bag first, because tf2 keeps the first transform of a stamp.
  for (auto path = paths.rbegin(); path != paths.rend(); ++path) addBag(*path);
  for (auto& [child, samples] : moving_) {
    std::stable_sort(samples.begin(), samples.end(),
                     [](const Sample& a, const Sample& b) { return a.stamp < b.stamp; });
    const auto end = std::unique(samples.begin(), samples.end(),
                                 [](const Sample& a, const Sample& b) { return a.stamp == b.stamp; });
    samples.erase(end, samples.end());
  }
}

void BagTransforms::addBag(const std::string& path) try {
  const rosbag::Bag bag = openBag(path);
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{"/tf", "/tf_static"}));
  std::map<std::string, std::size_t> refused;
  std::map<std::string, geometry_msgs::TransformStamped> fixed;
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<tf2_msgs::TFMessage>();
    if (!message) continue;
    const bool is_static = instance.getTopic() == "/tf_static";
    for (const geometry_msgs::TransformStamped& transform : message->transforms) {
      const std::string child = withoutSlash(transform.child_frame_id);
      if (isUnusable(transform)) {
        ++refused[child];
      } else {
        is_static ? void(fixed[child] = transform) : add(transform);
      }
    }
  }
  fixed_.merge(fixed);  // keeps the transforms of later bags, which were added before
  for (const auto& [child, count] : refused) {
    const std::string sentence = fmt::format(
        "{}: {} of frame '{}' left out: not finite, with a quaternion not of unit length, without a name, or "
        "from a frame to itself",
        path, count == 1 ? "1 transform" : fmt::format("{} transforms", count), child);
    refusals_.push_back({child, sentence});
  }
} catch (const rosbag::BagException& error) {
  throw damagedBag(path, error);
}

void BagTransforms::add(const geometry_msgs::TransformStamped& transform) {
  moving_[withoutSlash(transform.child_frame_id)].push_back(
      {transform.header.stamp, indexOf(withoutSlash(transform.header.frame_id)), transform.transform});
}

std::size_t BagTransforms::indexOf(const std::string& name) {
  const auto found = std::find(names_.begin(), names_.end(), name);
  const auto index = static_cast<std::size_t>(found - names_.begin());
  if (found == names_.end()) names_.push_back(name);
  return index;
}

/// The parent of a frame; empty for a root. As in tf2, a new parent is valid from its first transform on.
std::string BagTransforms::parentOf(const std::string& frame, const ros::Time& stamp) const {
  if (const auto fixed = fixed_.find(frame); fixed != fixed_.end())
    return withoutSlash(fixed->second.header.frame_id);
  const auto moving = moving_.find(frame);
  if (moving == moving_.end()) return "";
  const Samples& samples = moving->second;
  const auto after = firstFrom(samples, stamp);
  const bool exact = after != samples.end() && after->stamp == stamp;
  return names_[(exact || after == samples.begin() ? after : std::prev(after))->parent];
}

/// The frame, its parent, the parent's parent and so on.
std::vector<std::string> BagTransforms::ancestors(std::string frame, const ros::Time& stamp) const {
  std::vector<std::string> way;
  // Stop at a loop; tf2 reports it.
  for (; !frame.empty() && std::find(way.begin(), way.end(), frame) == way.end();
       frame = parentOf(frame, stamp)) {
    way.push_back(frame);
  }
  return way;
}

std::string BagTransforms::rootOf(const std::string& frame, const ros::Time& stamp) const {
  return ancestors(withoutSlash(frame), stamp).back();
}

bool BagTransforms::has(const std::string& frame) const {
  const auto is_parent = [&frame](const auto& child) {
    return withoutSlash(child.second.header.frame_id) == frame;
  };
  return fixed_.count(frame) > 0 || moving_.count(frame) > 0 ||
         std::find(names_.begin(), names_.end(), frame) != names_.end() ||
         std::any_of(fixed_.begin(), fixed_.end(), is_parent);
}

/// Adds a frame, and its ancestors at any time.
void BagTransforms::addAbove(const std::string& frame, std::set<std::string>* frames) const {
  if (!frames->insert(frame).second) return;
  if (const auto fixed = fixed_.find(frame); fixed != fixed_.end())
    return addAbove(withoutSlash(fixed->second.header.frame_id), frames);
  const auto moving = moving_.find(frame);
  if (moving == moving_.end()) return;
  std::set<std::size_t> parents;
  for (const Sample& sample : moving->second) parents.insert(sample.parent);
  for (const std::size_t parent : parents) addAbove(names_[parent], frames);
}

std::vector<std::string> BagTransforms::warnings() const {
  std::vector<std::string> sentences;
  for (const Refusal& refusal : refusals_) sentences.push_back(refusal.sentence);
  return sentences;
}

std::vector<std::string> BagTransforms::warnings(const std::string& target, const std::string& source) const {
  std::set<std::string> frames;
  addAbove(target, &frames);
  addAbove(source, &frames);
  std::vector<std::string> sentences;
  for (const Refusal& refusal : refusals_) {
    if (frames.count(refusal.frame) > 0) sentences.push_back(refusal.sentence);
  }
  return sentences;
}

/// Adds a frame's transforms to its parent just before and after a stamp.
void BagTransforms::addSamples(const std::string& frame, const ros::Time& stamp,
                               tf2::BufferCore* buffer) const {
  if (const auto fixed = fixed_.find(frame); fixed != fixed_.end()) {
    buffer->setTransform(fixed->second, "bag", true);
    return;
  }
  const auto moving = moving_.find(frame);
  if (moving == moving_.end()) return;
  const Samples& samples = moving->second;
  const auto after = firstFrom(samples, stamp);
  const bool exact = after != samples.end() && after->stamp == stamp;
  const auto first = exact || after == samples.begin() ? after : std::prev(after),
             last = after == samples.end() ? after : std::next(after);
  for (auto sample = first; sample != last; ++sample) {
    geometry_msgs::TransformStamped message;
    message.header.stamp = sample->stamp;
    message.header.frame_id = names_[sample->parent];
    message.child_frame_id = frame;
    message.transform = sample->transform;
    buffer->setTransform(message, "bag");
  }
  if (last - first < 2) return;
  const double gap_s = secondsBetween(first->stamp, after->stamp);
  const bool moved = first->parent != after->parent || differ(first->transform, after->transform);
  if (gap_s > kLongestGap_s && moved)
    throw tf2::ExtrapolationException(fmt::format(
        "/tf has no transform of {} for {:.3f} s; record /tf with the images, from their first to their last",
        frame, gap_s));
}

/// Gives tf2 only the samples around the stamp, because its search through a whole bag is linear.
Eigen::Isometry3d BagTransforms::at(const std::string& target_frame, const std::string& source_frame,
                                    const ros::Time& stamp) const {
  const std::string target = withoutSlash(target_frame), source = withoutSlash(source_frame);
  if (target == source) return Eigen::Isometry3d::Identity();
  std::vector<std::string> from = ancestors(source, stamp), to = ancestors(target, stamp);
  while (!from.empty() && !to.empty() && from.back() == to.back()) {
    from.pop_back();
    to.pop_back();
  }
  tf2::BufferCore buffer{ros::Duration(kWholeBag_s)};
  for (const std::string& frame : from) addSamples(frame, stamp, &buffer);
  for (const std::string& frame : to) addSamples(frame, stamp, &buffer);
  return tf2::transformToEigen(buffer.lookupTransform(target, source, stamp));
}

}  // namespace softbody
