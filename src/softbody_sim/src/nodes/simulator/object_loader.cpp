#include "nodes/simulator/object_loader.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <stdexcept>
#include <utility>

#include "nodes/give_way.h"
#include "softbody_sim/surroundings/pinned_vertices.h"

namespace softbody {
namespace {

constexpr char kSurfaceService[] = "surface/prepare_object";  // ~prepare_object of the surface
constexpr const char* kOtherParameters[] = {"surface/object", "feature_tracker/object"};

/// Values of parameters that are set; those that are not set stay so.
std::map<std::string, std::string> valuesOf(const std::vector<std::string>& parameters) {
  std::map<std::string, std::string> values;
  for (const std::string& parameter : parameters) {
    std::string value;
    if (ros::param::get(parameter, value)) values[parameter] = value;
  }
  return values;
}

}  // namespace

ObjectLoader::ObjectLoader(const ros::NodeHandle& node, const ros::NodeHandle& private_node, FileScope scope,
                           Owner owner)
    : scope_(scope),
      owner_(std::move(owner)),
      parameters_{private_node.resolveName("object")},
      node_calls_(node),
      thread_(private_node),
      surface_(ros::NodeHandle(node).serviceClient<softbody_msgs::LoadObject>(kSurfaceService)),
      service_(thread_.node.advertiseService("load_object", &ObjectLoader::onLoad, this)) {
  for (const char* parameter : kOtherParameters) parameters_.push_back(node.resolveName(parameter));
  thread_.spinner.start();
}

ObjectLoader::~ObjectLoader() {
  ends_ = true;
  service_.shutdown();
  thread_.spinner.stop();
}

bool ObjectLoader::onLoad(softbody_msgs::LoadObject::Request& request,
                          softbody_msgs::LoadObject::Response& response) try {
  giveWay();
  response.revision = load(request.object);
  response.success = 1;
  return true;
} catch (const std::exception& error) {
  response.message = error.what();
  ROS_WARN_STREAM("the object stays: " << response.message);
  return true;
}

/// @return the revision from which on there is the new object. @throw std::exception; nothing has changed.
std::uint32_t ObjectLoader::load(const std::string& object) {
  if (!std::filesystem::path(object).is_absolute())
    throw std::invalid_argument(fmt::format("object is '{}'; allowed: an absolute path", object));
  ROS_INFO_STREAM("loading " << object << "; the present object goes on");
  SimulatedObject loaded = loadSimulatedObject(object, scope_);
  BodySurface surface = BodySurface(loaded.model.visual, loaded.model.volume).in(loaded.model.volume);
  for (const PinRegion& pin : loaded.pins) PinnedVertices(pin, surface, loaded.model.volume.rest_vertices);
  askSurface(object);
  try {
    const std::uint32_t revision = inNode<std::uint32_t>(owner_.revision) + 1;
    loaded.model.volume.revision = revision;
    use(make(loaded, std::move(surface), inNode<SimulatorConfig>(owner_.config)), object);
    return revision;
  } catch (...) {
    letSurfaceForget();
    throw;
  }
}

/// A graph may have no surface.
void ObjectLoader::askSurface(const std::string& object) {
  if (!surface_.exists()) return;
  softbody_msgs::LoadObject call;
  call.request.object = object;
  if (!surface_.call(call)) throw std::runtime_error(surface_.getService() + " does not answer");
  if (!call.response.success)
    throw std::invalid_argument(fmt::format("{}: {}", surface_.getService(), call.response.message));
}

/// It keeps the mesh until then, and may have ended.
void ObjectLoader::letSurfaceForget() {
  softbody_msgs::LoadObject nothing;
  if (surface_.exists()) surface_.call(nothing);
}

std::shared_ptr<NextObject> ObjectLoader::make(const SimulatedObject& object, BodySurface surface,
                                               const SimulatorConfig& config) const {
  auto next = std::make_shared<NextObject>(
      NextObject{{object.model.volume, object.model.material, config}, object.pins, std::move(surface)});
  next->simulator.prepare();
  return next;
}

/// The parameters come first: the other nodes read them when the new body comes.
void ObjectLoader::use(const std::shared_ptr<NextObject>& next, const std::string& object) {
  const std::map<std::string, std::string> before = valuesOf(parameters_);
  for (const auto& [parameter, path] : before) ros::param::set(parameter, object);
  try {
    inNode<bool>([next, take = owner_.use] {
      take(next.get());
      return true;
    });
  } catch (...) {
    for (const auto& [parameter, path] : before) ros::param::set(parameter, path);
    throw;
  }
}

template <typename Result>
Result ObjectLoader::inNode(std::function<Result()> function) {
  std::optional<Result> result =
      node_calls_.result<Result>(std::move(function), [this] { return ends_ || !ros::ok(); });
  if (!result) throw std::runtime_error("the simulator ends");
  return *std::move(result);
}

}  // namespace softbody
