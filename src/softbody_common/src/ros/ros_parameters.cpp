#include "softbody_common/ros/ros_parameters.h"

#include <ros/console.h>
#include <yaml-cpp/yaml.h>

namespace softbody {
namespace {

YAML::Node toYaml(XmlRpc::XmlRpcValue& value) {
  using XmlRpc::XmlRpcValue;
  switch (value.getType()) {
    case XmlRpcValue::TypeBoolean:
      return YAML::Node(static_cast<bool&>(value));
    case XmlRpcValue::TypeInt:
      return YAML::Node(static_cast<int&>(value));
    case XmlRpcValue::TypeDouble:
      return YAML::Node(static_cast<double&>(value));
    case XmlRpcValue::TypeString:
      return YAML::Node(static_cast<std::string&>(value));
    case XmlRpcValue::TypeArray: {
      YAML::Node list(YAML::NodeType::Sequence);
      for (int i = 0; i < value.size(); ++i) list.push_back(toYaml(value[i]));
      return list;
    }
    case XmlRpcValue::TypeStruct: {
      YAML::Node map(YAML::NodeType::Map);
      for (auto& entry : value) map[entry.first] = toYaml(entry.second);
      return map;
    }
    default:
      return YAML::Node();
  }
}

}  // namespace

Parameters readParameters(const ros::NodeHandle& private_handle) {
  XmlRpc::XmlRpcValue values;
  const bool any = private_handle.getParam("", values) && values.getType() == XmlRpc::XmlRpcValue::TypeStruct;
  return Parameters(any ? toYaml(values) : YAML::Node(), private_handle.getNamespace() + "/");
}

void warnUnknown(const Parameters& parameters) {
  for (const std::string& key : parameters.unknown())
    ROS_WARN_STREAM("unknown parameter " << key << " is ignored");
}

}  // namespace softbody
