#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <stdexcept>

#include "softbody_sim/object_model.h"

namespace softbody {
namespace {

constexpr double kQuaternionTolerance = 0.01;  ///< people round

/// Reads values of one map of a YAML file; errors carry "file:line: key".
class MapReader {
 public:
  MapReader(const YAML::Node& map, std::string path, std::string prefix)
      : map_(map), path_(std::move(path)), prefix_(std::move(prefix)) {
    if (!map_.IsMap()) fail(map_, fmt::format("'{}' must be a map of keys and values", prefix_));
  }

  bool has(const std::string& key) { return get(key).IsDefined(); }

  std::string text(const std::string& key) {
    const YAML::Node node = get(key);
    if (!node.IsDefined()) return "";
    if (!node.IsScalar() || node.Scalar().empty())
      fail(node, fmt::format("{}{} must be a text", prefix_, key));
    return node.Scalar();
  }

  double number(const std::string& key, double fallback, double min, double max) {
    const YAML::Node node = get(key);
    if (!node.IsDefined()) return fallback;
    double value = 0.0;
    const bool readable = node.IsScalar() && YAML::convert<double>::decode(node, value);
    // Negated so that NaN is refused too.
    if (!readable || !(value >= min && value <= max)) {
      fail(node,
           fmt::format("{}{} is '{}'; allowed: a number from {} to {}", prefix_, key, shown(node), min, max));
    }
    return value;
  }

  std::vector<double> numbers(const std::string& key, std::size_t count) {
    const YAML::Node node = get(key);
    std::vector<double> values;
    for (const YAML::Node& entry : node) {
      double value = 0.0;
      if (entry.IsScalar() && YAML::convert<double>::decode(entry, value) && std::isfinite(value))
        values.push_back(value);
    }
    if (!node.IsSequence() || node.size() != count || values.size() != count) {
      fail(node, fmt::format("{}{} is '{}'; allowed: a list of {} finite numbers", prefix_, key, shown(node),
                             count));
    }
    return values;
  }

  /// An existing file, relative to the YAML; empty if the key is not there.
  std::string file(const std::string& key) {
    const std::string name = text(key);
    if (name.empty()) return "";
    const auto file = std::filesystem::absolute(std::filesystem::path(path_)).parent_path() / name;
    if (!std::filesystem::is_regular_file(file)) {
      fail(get(key), fmt::format("{}{} is '{}'; there is no file {}", prefix_, key, name,
                                 file.lexically_normal().string()));
    }
    return file.lexically_normal().string();
  }

  YAML::Node get(const std::string& key) {
    known_.insert(key);
    const YAML::Node& map = map_;  // the const operator[] does not insert
    return map[key] ? map[key] : YAML::Node(YAML::NodeType::Undefined);
  }

  void warnOfUnknown(Warnings* warnings) const {
    for (const auto& entry : map_) {
      const std::string key = shown(entry.first);
      if (known_.count(key) > 0) continue;
      warnings->push_back(fmt::format("{}:{}: unknown key {}{} is ignored", path_,
                                      entry.first.Mark().line + 1, prefix_, key));
    }
  }

  [[noreturn]] void fail(const YAML::Node& node, const std::string& what) const {
    throw std::invalid_argument(
        fmt::format("{}:{}: {}", path_, (node.IsDefined() ? node : map_).Mark().line + 1, what));
  }

  static std::string shown(const YAML::Node& node) { return node.IsDefined() ? YAML::Dump(node) : "missing"; }

 private:
  YAML::Node map_;
  std::string path_;
  std::string prefix_;
  std::set<std::string> known_;
};

YAML::Node parse(const std::string& path) {
  try {
    return YAML::LoadFile(path);
  } catch (const YAML::BadFile&) {
    throw std::invalid_argument(path + ": cannot be read");
  } catch (const YAML::ParserException& error) {
    throw std::invalid_argument(fmt::format("{}:{}: not YAML: {}", path, error.mark.line + 1, error.msg));
  }
}

double readUnit(MapReader& object) {
  if (!object.has("unit")) return 1.0;
  try {
    return metresPer(object.text("unit"));
  } catch (const std::invalid_argument& error) {
    object.fail(object.get("unit"), fmt::format("object/unit: {}", error.what()));
  }
}

Material readMaterial(MapReader& material) {
  Material result;
  result.youngs_modulus_pa = material.number("youngs_modulus_pa", result.youngs_modulus_pa, 1.0, 1e12);
  result.poisson_ratio = material.number("poisson_ratio", result.poisson_ratio, 0.0, 0.495);
  result.density_kg_m3 = material.number("density_kg_m3", result.density_kg_m3, 0.1, 30000.0);
  result.damping = material.number("damping", result.damping, 0.0, 1.0);
  return result;
}

Eigen::Isometry3d readPose(MapReader& object) {
  const std::vector<double> p = object.numbers("initial_pose", 7);
  const Eigen::Quaterniond rotation(p[6], p[3], p[4], p[5]);
  if (!(std::abs(rotation.norm() - 1.0) <= kQuaternionTolerance)) {
    object.fail(
        object.get("initial_pose"),
        fmt::format("object/initial_pose is '{}'; its quaternion (the last four: x y z w) has length {:.4g}; "
                    "allowed: 0.99 to 1.01",
                    MapReader::shown(object.get("initial_pose")), rotation.norm()));
  }
  return Eigen::Translation3d(p[0], p[1], p[2]) * rotation.normalized();
}

/// `object/pins`: a list of maps with name, min, max and, if they move, frame. The box is in file units.
std::vector<PinRegion> readPins(MapReader& object, const std::string& path, double unit_m,
                                Warnings* warnings) {
  std::vector<PinRegion> pins;
  const YAML::Node list = object.get("pins");
  if (!list.IsDefined()) return pins;
  if (!list.IsSequence()) object.fail(list, "object/pins must be a list of maps");
  for (std::size_t i = 0; i < list.size(); ++i) {
    MapReader reader(list[i], path, fmt::format("object/pins/{}/", i));
    PinRegion pin{reader.text("name"), reader.text("frame"), {}, {}};
    if (pin.name.empty()) pin.name = fmt::format("pin{}", i);
    pin.min = unit_m * Eigen::Vector3d(reader.numbers("min", 3).data());
    pin.max = unit_m * Eigen::Vector3d(reader.numbers("max", 3).data());
    if (!(pin.min.array() <= pin.max.array()).all())
      reader.fail(list[i], fmt::format("object/pins/{}: min must not exceed max", i));
    reader.warnOfUnknown(warnings);
    pins.push_back(pin);
  }
  return pins;
}

}  // namespace

double metresPer(const std::string& unit) {
  static const std::map<std::string, double> kUnits{
      {"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"inch", 0.0254}};
  const auto found = kUnits.find(unit);
  if (found == kUnits.end())
    throw std::invalid_argument(fmt::format("unit is '{}'; allowed: m, cm, mm, inch", unit));
  return found->second;
}

ObjectDescription loadObjectDescription(const std::string& yaml_path) {
  MapReader file(parse(yaml_path), yaml_path, "");
  if (!file.has("object")) file.fail(file.get("object"), "the key 'object' is missing");
  MapReader object(file.get("object"), yaml_path, "object/");
  ObjectDescription description;
  description.visual_mesh = object.file("visual_mesh");
  if (description.visual_mesh.empty())
    object.fail(object.get("visual_mesh"), "object/visual_mesh is missing");
  description.cage_mesh = object.file("cage_mesh");
  description.tet_mesh = object.file("tet_mesh");
  description.unit_m = readUnit(object);
  if (object.has("material")) {
    MapReader material(object.get("material"), yaml_path, "object/material/");
    description.material = readMaterial(material);
    material.warnOfUnknown(&description.warnings);
  }
  if (object.has("initial_pose")) description.initial_pose = readPose(object);
  description.pins = readPins(object, yaml_path, description.unit_m, &description.warnings);
  object.warnOfUnknown(&description.warnings);
  file.warnOfUnknown(&description.warnings);
  return description;
}

}  // namespace softbody
