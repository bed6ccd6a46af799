#include <fmt/format.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2/buffer_core.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include <stdexcept>

#include "softbody_bringup/evaluation/bags.h"
#include "softbody_common/conversions.h"

namespace softbody::evaluation {
namespace {

constexpr double kWholeBag_s = 1e6;

void addTransforms(const std::string& path, tf2::BufferCore* buffer) {
  const rosbag::Bag bag(path, rosbag::bagmode::Read);
  rosbag::View view(bag, rosbag::TopicQuery(std::vector<std::string>{"/tf", "/tf_static"}));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<tf2_msgs::TFMessage>();
    if (!message) continue;
    for (const geometry_msgs::TransformStamped& transform : message->transforms)
      buffer->setTransform(transform, path, instance.getTopic() == "/tf_static");
  }
}

}  // namespace

std::size_t expressIn(const std::string& frame_id, const std::vector<std::string>& paths,
                      SurfaceRecord* surface) {
  if (surface->frame_id == frame_id) return 0;
  tf2::BufferCore buffer{ros::Duration(kWholeBag_s)};
  for (const std::string& path : paths) addTransforms(path, &buffer);
  std::map<Nanoseconds, MeshState> transformed;
  std::string reason;
  for (auto& [stamp, state] : surface->states) {
    try {
      const Eigen::Isometry3d pose =
          tf2::transformToEigen(buffer.lookupTransform(frame_id, surface->frame_id, toTime(stamp)));
      MeshState moved = state;
      moved.vertices =
          (state.vertices * pose.linear().transpose()).rowwise() + pose.translation().transpose();
      transformed[stamp] = std::move(moved);
    } catch (const tf2::TransformException& error) {
      reason = error.what();
    }
  }
  if (transformed.empty()) {
    throw std::invalid_argument(
        fmt::format("the result's surface is in frame '{}' and /tf does not lead to '{}': {}",
                    surface->frame_id, frame_id, reason));
  }
  const std::size_t left_out = surface->states.size() - transformed.size();
  surface->states = std::move(transformed);
  surface->frame_id = frame_id;
  return left_out;
}

}  // namespace softbody::evaluation
