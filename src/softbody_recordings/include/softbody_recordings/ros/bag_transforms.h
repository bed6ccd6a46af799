#pragma once

#include <geometry_msgs/Transform.h>
#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>
#include <tf2/buffer_core.h>

#include <Eigen/Geometry>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace softbody {

/// All of /tf and /tf_static in bags, whenever it was recorded: nothing is late, as it may be for a live
/// graph. What tf2 refuses, not finite, with a quaternion not of unit length, without a name
/// or from a frame to itself, is left out.
class BagTransforms {
 public:
  /// @param paths of bags; of two transforms of one stamp that of the later bag counts, in one bag the
  /// first, as for tf2, but of /tf_static the last.
  /// @throw std::exception with the path if a bag cannot be read.
  explicit BagTransforms(const std::vector<std::string>& paths);

  /// T_target_source at a stamp. @throw tf2::TransformException if the bags do not tell it: frames that are
  /// not connected, a stamp before the first or after the last of /tf, or in a gap of more than half a second
  /// in which a frame between the two has moved or got another parent.
  Eigen::Isometry3d at(const std::string& target_frame, const std::string& source_frame,
                       const ros::Time& stamp) const;

  /// A sentence for each frame of which transforms were left out.
  std::vector<std::string> warnings() const;
  /// Only for frames that may be between the two: either, and what they ever hung on.
  std::vector<std::string> warnings(const std::string& target, const std::string& source) const;

 private:
  struct Sample {
    ros::Time stamp;
    std::size_t parent;  ///< in names_
    geometry_msgs::Transform transform;
  };
  struct Refusal {
    std::string frame, sentence;
  };
  using Samples = std::vector<Sample>;  ///< of one frame, in the order of their stamps

  void addBag(const std::string& path);
  void add(const geometry_msgs::TransformStamped& transform);
  std::size_t indexOf(const std::string& name);
  std::string parentOf(const std::string& frame, const ros::Time& stamp) const;
  void addAbove(const std::string& frame, std::set<std::string>* frames) const;
  std::vector<std::string> wayUp(std::string frame, const ros::Time& stamp) const;
  void tell(const std::string& frame, const ros::Time& stamp, tf2::BufferCore* buffer) const;

  std::vector<std::string> names_;                                ///< of parents
  std::map<std::string, geometry_msgs::TransformStamped> fixed_;  ///< /tf_static by child
  std::map<std::string, Samples> moving_;                         ///< /tf by child
  std::vector<Refusal> refusals_;
};

}  // namespace softbody
