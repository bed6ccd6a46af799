#pragma once

#include <ros/time.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace softbody {

/// All of /tf and /tf_static in bags, whenever it was recorded: nothing is late, as it may be for a live
/// graph.
class BagTransforms {
 public:
  /// @param paths of bags; of two transforms of one stamp that of the later bag counts.
  /// @throw std::exception with the path if a bag cannot be read.
  explicit BagTransforms(const std::vector<std::string>& paths);

  /// T_target_source at a stamp. @throw tf2::TransformException if the bags do not tell it: frames that are
  /// not connected, a stamp before the first or after the last of /tf, or in a gap of more than half a
  /// second.
  Eigen::Isometry3d at(const std::string& target, const std::string& source, const ros::Time& stamp) const;

 private:
  void addBag(const std::string& path);
  bool climbsTo(const std::string& top, std::string frame, const ros::Time& stamp) const;

  tf2::BufferCore buffer_;
  std::map<std::string, std::set<ros::Time>> stamps_;  ///< of the transforms that move a frame
};

}  // namespace softbody
