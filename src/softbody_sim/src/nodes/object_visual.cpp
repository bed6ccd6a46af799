#include "nodes/object_visual.h"

#include <utility>

#include "nodes/give_way.h"
#include "softbody_sim/object/object_description.h"
#include "softbody_sim/object/visual_mesh.h"

namespace softbody {

ObjectVisual::ObjectVisual(const ros::NodeHandle& private_node, const std::string& object, FileScope scope)
    : scope_(scope),
      private_node_(private_node),
      present_(load(object)),
      thread_(private_node),
      service_(thread_.node.advertiseService("prepare_object", &ObjectVisual::onPrepare, this)) {
  thread_.spinner.start();
}

ObjectVisual::~ObjectVisual() {
  service_.shutdown();
  thread_.spinner.stop();
}

ObjectVisual::Loaded ObjectVisual::load(const std::string& object) const {
  const ObjectDescription description = loadObjectDescription(object, scope_);
  Warnings warnings = description.warnings;
  Loaded loaded{object, loadVisualMesh(description, &warnings)};
  for (const std::string& warning : warnings) ROS_WARN_STREAM(object << ": " << warning);
  return loaded;
}

bool ObjectVisual::update() {
  std::string object = present_.object;
  private_node_.getParam("object", object);
  std::optional<Loaded> next = takePrepared(object);
  if (!next && object == present_.object) return false;
  present_ = next ? *std::move(next) : load(object);
  return true;
}

std::optional<ObjectVisual::Loaded> ObjectVisual::takePrepared(const std::string& object) {
  const std::lock_guard<std::mutex> lock(prepared_mutex_);
  if (!prepared_ || prepared_->object != object) return std::nullopt;
  return std::exchange(prepared_, std::nullopt);
}

bool ObjectVisual::onPrepare(softbody_msgs::LoadObject::Request& request,
                             softbody_msgs::LoadObject::Response& response) try {
  giveWay();
  std::optional<Loaded> loaded;
  if (!request.object.empty()) loaded = load(request.object);
  const std::lock_guard<std::mutex> lock(prepared_mutex_);
  prepared_ = std::move(loaded);
  response.success = 1;
  return true;
} catch (const std::exception& error) {
  response.message = error.what();
  return true;
}

}  // namespace softbody
