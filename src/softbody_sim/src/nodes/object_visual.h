#pragma once

#include <ros/ros.h>
#include <softbody_msgs/LoadObject.h>

#include <mutex>
#include <optional>
#include <string>

#include "nodes/own_thread.h"
#include "softbody_common/files/input_file.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// The visual mesh of the object that the parameter ~object names. The simulator changes the parameter when
/// it loads another object. Before, it calls the service ~prepare_object, which loads the mesh in a thread of
/// its own. After a refusal it calls it with an empty object: the mesh is forgotten.
class ObjectVisual {
 public:
  /// @param object the parameter's value at the start. @throw std::invalid_argument if a file of the object
  /// cannot be used.
  ObjectVisual(const ros::NodeHandle& private_node, const std::string& object, FileScope scope);
  ~ObjectVisual();

  /// The uncut mesh.
  const MeshTopology& mesh() const { return present_.mesh; }

  /// To be called when another body comes: takes the mesh that the parameter names now.
  /// @return whether it is another one. @throw std::invalid_argument as the constructor; the mesh stays.
  bool update();

 private:
  struct Loaded {
    std::string object;
    MeshTopology mesh;
  };

  bool onPrepare(softbody_msgs::LoadObject::Request& request, softbody_msgs::LoadObject::Response& response);
  Loaded load(const std::string& object) const;
  std::optional<Loaded> takePrepared(const std::string& object);

  const FileScope scope_;
  ros::NodeHandle private_node_;
  Loaded present_;
  std::mutex prepared_mutex_;
  std::optional<Loaded> prepared_;
  OwnThread thread_;
  ros::ServiceServer service_;
};

}  // namespace softbody
