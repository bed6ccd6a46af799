#include "softbody_common/files/yaml_map_reader.h"

#include <fmt/format.h>
#include <yaml-cpp/depthguard.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace softbody {
namespace {

constexpr double kQuaternionTolerance = 0.01;  // users round numbers
constexpr std::size_t kLargestYaml = 1 << 20;  // [bytes] yaml-cpp needs a hundred times as much memory

}  // namespace

YAML::Node parseYamlFile(const std::string& path) {
  const std::string text = readFile(path);
  if (text.size() > kLargestYaml)
    throw std::invalid_argument(
        fmt::format("{}: has {} bytes; a YAML file may have up to {}", path, text.size(), kLargestYaml));
  try {
    return YAML::Load(text);
  } catch (const YAML::DeepRecursion& error) {
    throw std::invalid_argument(
        fmt::format("{}:{}: not YAML: it is nested too deeply; take levels out", path, error.mark.line + 1));
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(fmt::format("{}:{}: not YAML: {}", path, error.mark.line + 1, error.msg));
  }
}

YamlMapReader::YamlMapReader(const YAML::Node& map, std::string path, std::string prefix)
    : map_(map), path_(std::move(path)), prefix_(std::move(prefix)) {
  if (map_.IsMap()) return;
  if (!prefix_.empty()) fail(map_, fmt::format("'{}' must be a map of keys and values", prefix_));
  fail(map_, "the file must have lines with KEY: VALUE; is it another kind of file?");
}

bool YamlMapReader::has(const std::string& key) { return get(key).IsDefined(); }

YAML::Node YamlMapReader::get(const std::string& key) {
  known_.insert(key);
  const YAML::Node& map = map_;  // the const operator[] does not insert the key
  return map[key] ? map[key] : YAML::Node(YAML::NodeType::Undefined);
}

std::string YamlMapReader::text(const std::string& key) {
  const YAML::Node node = get(key);
  if (!node.IsDefined()) return "";
  if (!node.IsScalar() || node.Scalar().empty()) fail(node, fmt::format("{}{} must be a text", prefix_, key));
  return node.Scalar();
}

double YamlMapReader::number(const std::string& key, double fallback, double min, double max) {
  return has(key) ? requiredNumber(key, min, max) : fallback;
}

double YamlMapReader::requiredNumber(const std::string& key, double min, double max) {
  const YAML::Node node = get(key);
  double value = 0.0;
  const bool readable = node.IsDefined() && node.IsScalar() && YAML::convert<double>::decode(node, value);
  // Negated to refuse NaN too.
  if (!readable || !(value >= min && value <= max)) {
    fail(node,
         fmt::format("{}{} is '{}'; allowed: a number from {} to {}", prefix_, key, shown(node), min, max));
  }
  return value;
}

int YamlMapReader::requiredInteger(const std::string& key, int min, int max) {
  const YAML::Node node = get(key);
  int value = 0;
  const bool readable = node.IsDefined() && node.IsScalar() && YAML::convert<int>::decode(node, value);
  if (!readable || value < min || value > max) {
    fail(node, fmt::format("{}{} is '{}'; allowed: a whole number from {} to {}", prefix_, key, shown(node),
                           min, max));
  }
  return value;
}

std::vector<double> YamlMapReader::numbers(const std::string& key, std::size_t count) {
  const YAML::Node node = get(key);
  std::vector<double> values;
  for (const YAML::Node& entry : node) {
    double value = 0.0;
    if (entry.IsScalar() && YAML::convert<double>::decode(entry, value) && std::isfinite(value))
      values.push_back(value);
  }
  if (!node.IsSequence() || node.size() != count || values.size() != count) {
    fail(node,
         fmt::format("{}{} is '{}'; allowed: a list of {} finite numbers", prefix_, key, shown(node), count));
  }
  return values;
}

Eigen::Isometry3d YamlMapReader::pose(const std::string& key) {
  const std::vector<double> p = numbers(key, 7);
  const Eigen::Quaterniond rotation(p[6], p[3], p[4], p[5]);
  if (!(std::abs(rotation.norm() - 1.0) <= kQuaternionTolerance)) {
    fail(get(key), fmt::format("{}{} is '{}'; its quaternion (the last four: x y z w) has length {:.4g}; "
                               "allowed: 0.99 to 1.01",
                               prefix_, key, shown(get(key)), rotation.norm()));
  }
  return Eigen::Translation3d(p[0], p[1], p[2]) * rotation.normalized();
}

std::string YamlMapReader::file(const std::string& key, FileScope scope) {
  const std::string name = text(key);
  if (name.empty()) return "";
  const auto folder = std::filesystem::absolute(std::filesystem::path(path_)).parent_path();
  const auto file = folder / name;
  if (scope == FileScope::kOwnFolder && !isInside(file, folder)) {
    fail(get(key), fmt::format("{}{} is '{}': {}", prefix_, key, name, outsideSentence(file, folder)));
  }
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) {
    fail(get(key), fmt::format("{}{} is '{}'; there is no file {}", prefix_, key, name,
                               file.lexically_normal().string()));
  }
  return file.lexically_normal().string();
}

YamlMapReader YamlMapReader::map(const std::string& key) {
  if (!has(key)) {
    std::string keys;
    for (const auto& entry : map_) keys += (keys.empty() ? "" : ", ") + shown(entry.first);
    fail(get(key), fmt::format("the key '{}{}' is missing; the keys here are: {}", prefix_, key,
                               keys.empty() ? "none" : keys));
  }
  return {get(key), path_, prefix_ + key + "/"};
}

void YamlMapReader::warnOfUnknown(std::vector<std::string>* warnings) const {
  for (const auto& entry : map_) {
    const std::string key = shown(entry.first);
    if (known_.count(key) > 0) continue;
    warnings->push_back(
        fmt::format("{}:{}: unknown key {}{} is ignored", path_, entry.first.Mark().line + 1, prefix_, key));
  }
}

void YamlMapReader::fail(const YAML::Node& node, const std::string& what) const {
  throw std::invalid_argument(
      fmt::format("{}:{}: {}", path_, (node.IsDefined() ? node : map_).Mark().line + 1, what));
}

std::string YamlMapReader::shown(const YAML::Node& node) {
  return node.IsDefined() ? YAML::Dump(node) : "missing";
}

}  // namespace softbody
