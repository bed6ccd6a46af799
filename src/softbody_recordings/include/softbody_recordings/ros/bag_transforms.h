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

/// All transforms of /tf and /tf_static in bags; unlike in a live graph, no transform is late. Leaves out the
/// transforms that tf2 refuses: not finite, with a quaternion not of unit length, without a frame name, or
/// from a frame to itself.
class BagTransforms {
 public:
  /// @param paths of bags. If two transforms have the same stamp, the one of the later bag is used. Within
  /// one bag it is the first, as in tf2; for /tf_static it is the last.
  /// @throw std::exception with the path if a bag cannot be read.
  explicit BagTransforms(const std::vector<std::string>& paths);

  /// T_target_source at a stamp.
  /// @throw tf2::TransformException if the frames are not connected, if the stamp is before the first or
  /// after the last transform, or if it is in a gap of more than half a second in which a frame has moved or
  /// has got another parent.
  Eigen::Isometry3d at(const std::string& target_frame, const std::string& source_frame,
                       const ros::Time& stamp) const;

  /// The frame above a frame that has no parent itself; the frame if it has none.
  std::string rootOf(const std::string& frame, const ros::Time& stamp) const;

  /// Whether any transform names a frame.
  bool has(const std::string& frame) const;

  /// One sentence for each frame with transforms that were left out.
  std::vector<std::string> warnings() const;
  /// The same, only for the two frames and all their ancestors.
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
  using Samples = std::vector<Sample>;  ///< of one frame, sorted by stamp

  void addBag(const std::string& path);
  void add(const geometry_msgs::TransformStamped& transform);
  std::size_t indexOf(const std::string& name);
  std::string parentOf(const std::string& frame, const ros::Time& stamp) const;
  void addAbove(const std::string& frame, std::set<std::string>* frames) const;
  std::vector<std::string> ancestors(std::string frame, const ros::Time& stamp) const;
  void addSamples(const std::string& frame, const ros::Time& stamp, tf2::BufferCore* buffer) const;

  std::vector<std::string> names_;                                ///< of parents
  std::map<std::string, geometry_msgs::TransformStamped> fixed_;  ///< /tf_static by child
  std::map<std::string, Samples> moving_;                         ///< /tf by child
  std::vector<Refusal> refusals_;
};

}  // namespace softbody
