#pragma once

#include <ros/ros.h>
#include <softbody_msgs/LoadObject.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "nodes/node_calls.h"
#include "nodes/own_thread.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/ros/simulator_options.h"
#include "softbody_sim/surroundings/body_surface.h"

namespace softbody {

/// An object that is ready to be simulated.
struct NextObject {
  Simulator simulator;
  std::vector<PinRegion> pins;
  BodySurface surface;  ///< in the tets of the simulator; the pins are meant about it
};

/// The service ~load_object: another object without a restart. Object and simulator are made in a thread of
/// their own, while the present object goes on. The surface, if it runs, checks the object's visual mesh. If
/// all is usable, the parameters ~object of this node, the surface and the feature tracker get the new path,
/// so that a node that starts again has the same object. Then the node takes it over.
class ObjectLoader {
 public:
  /// All are called in the node's queue.
  struct Owner {
    std::function<std::uint32_t()> revision;  ///< of the present body
    std::function<SimulatorConfig()> config;  ///< for the next one
    /// Takes over the next object. If it throws std::exception, nothing has changed.
    std::function<void(NextObject*)> use;
  };

  /// @param scope of the files that an object names.
  ObjectLoader(const ros::NodeHandle& node, const ros::NodeHandle& private_node, FileScope scope,
               Owner owner);
  ~ObjectLoader();

 private:
  bool onLoad(softbody_msgs::LoadObject::Request& request, softbody_msgs::LoadObject::Response& response);
  std::uint32_t load(const std::string& object);
  void askSurface(const std::string& object);
  void letSurfaceForget();
  std::shared_ptr<NextObject> make(const SimulatedObject& object, BodySurface surface,
                                   const SimulatorConfig& config) const;
  void use(const std::shared_ptr<NextObject>& next, const std::string& object);
  template <typename Result>
  Result inNode(std::function<Result()> function);

  const FileScope scope_;
  const Owner owner_;
  std::vector<std::string> parameters_;  ///< names of the parameters with the path of the object
  std::atomic<bool> ends_{false};
  NodeCalls node_calls_;
  OwnThread thread_;
  ros::ServiceClient surface_;
  ros::ServiceServer service_;
};

}  // namespace softbody
