#include "softbody_common/ros/live_parameters.h"

#include <dynamic_reconfigure/ConfigDescription.h>
#include <yaml-cpp/yaml.h>

#include <stdexcept>

namespace softbody {
namespace {

using dynamic_reconfigure::Config;
using ValueMap = std::map<std::string, ParameterValue>;

constexpr char kGroup[] = "Default";  // the only one, with the number 0

/// A message of one kind of value.
template <typename Message, typename Value>
Message named(const std::string& name, const Value& value) {
  Message message;
  message.name = name;
  message.value = value;
  return message;
}

void addValue(const std::string& name, const ParameterValue& value, Config* config) {
  using namespace dynamic_reconfigure;
  if (const auto* flag = std::get_if<bool>(&value))
    config->bools.push_back(named<BoolParameter>(name, *flag));
  else if (const auto* integer = std::get_if<int>(&value))
    config->ints.push_back(named<IntParameter>(name, *integer));
  else if (const auto* number = std::get_if<double>(&value))
    config->doubles.push_back(named<DoubleParameter>(name, *number));
  else
    config->strs.push_back(named<StrParameter>(name, std::get<std::string>(value)));
}

Config toConfig(const ValueMap& values) {
  Config config;
  for (const auto& [name, value] : values) addValue(name, value, &config);
  config.groups.resize(1);
  config.groups.front().name = kGroup;
  config.groups.front().state = 1;
  return config;
}

ValueMap valuesIn(const Config& config) {
  ValueMap values;
  for (const auto& flag : config.bools) values[flag.name] = flag.value != 0;
  for (const auto& integer : config.ints) values[integer.name] = integer.value;
  for (const auto& number : config.doubles) values[number.name] = number.value;
  for (const auto& text : config.strs) values[text.name] = text.value;
  return values;
}

/// The ends of a parameter's range, as values of its type.
std::pair<ParameterValue, ParameterValue> rangeOf(const ParameterDescription& p) {
  if (p.type == "int") return {static_cast<int>(p.range.min), static_cast<int>(p.range.max)};
  return {p.range.min, p.range.max};
}

dynamic_reconfigure::ConfigDescription descriptionOf(const std::vector<ParameterDescription>& parameters,
                                                     const ValueMap& values) {
  dynamic_reconfigure::ConfigDescription message;
  message.min = message.max = toConfig(ValueMap());
  message.dflt = toConfig(values);
  message.groups.resize(1);
  message.groups.front().name = kGroup;
  for (const ParameterDescription& p : parameters) {
    if (values.count(p.name) == 0) continue;
    dynamic_reconfigure::ParamDescription description;
    description.name = p.name;
    description.type = p.type;
    description.description = withoutMarkdown(p.meaning) + (p.unit.empty() ? "" : " [" + p.unit + "]");
    message.groups.front().parameters.push_back(description);
    const auto [min, max] = rangeOf(p);
    addValue(p.name, min, &message.min);
    addValue(p.name, max, &message.max);
  }
  return message;
}

/// The values that are not yet those of `now`.
ValueMap newIn(const ValueMap& values, const ValueMap& now) {
  ValueMap changed;
  for (const auto& [name, value] : values) {
    const auto present = now.find(name);
    if (present == now.end() || present->second != value) changed.emplace(name, value);
  }
  return changed;
}

YAML::Node toYaml(const ValueMap& values) {
  YAML::Node yaml(YAML::NodeType::Map);
  for (const auto& entry : values)
    std::visit([&](const auto& value) { yaml[entry.first] = value; }, entry.second);
  return yaml;
}

}  // namespace

LiveParameters::LiveParameters(const ros::NodeHandle& private_node,
                               const std::vector<ParameterDescription>& parameters, Values values,
                               Change change)
    : private_node_(private_node),
      values_(std::move(values)),
      change_(std::move(change)),
      published_(values_()),
      descriptions_(
          private_node_.advertise<dynamic_reconfigure::ConfigDescription>("parameter_descriptions", 1, true)),
      updates_(private_node_.advertise<Config>("parameter_updates", 1, true)) {
  descriptions_.publish(descriptionOf(parameters, published_));
  updates_.publish(toConfig(published_));
  set_parameters_ = private_node_.advertiseService("set_parameters", &LiveParameters::onSet, this);
}

void LiveParameters::publishChanges() {
  const ValueMap now = values_();
  for (const auto& entry : newIn(now, published_))
    std::visit([&](const auto& value) { private_node_.setParam(entry.first, value); }, entry.second);
  published_ = now;
  updates_.publish(toConfig(published_));
}

/// A tool that sends all values changes only those that differ. The reason of a refusal goes to the caller
/// and to the log as the error of the service.
bool LiveParameters::onSet(dynamic_reconfigure::Reconfigure::Request& request,
                           dynamic_reconfigure::Reconfigure::Response& response) {
  Parameters given(toYaml(newIn(valuesIn(request.config), values_())), private_node_.getNamespace() + "/");
  try {
    change_(given);
  } catch (...) {
    publishChanges();  // a slider goes back
    throw;
  }
  publishChanges();
  response.config = toConfig(published_);
  return true;
}

}  // namespace softbody
