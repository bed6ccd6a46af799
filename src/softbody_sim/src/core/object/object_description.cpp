#include "softbody_sim/object/object_description.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <limits>
#include <map>
#include <stdexcept>

#include "softbody_common/files/object_path.h"
#include "softbody_common/files/yaml_map_reader.h"

namespace softbody {
namespace {

double readUnit(YamlMapReader& object) {
  if (!object.has("unit")) return 1.0;
  try {
    return metresPer(object.text("unit"));
  } catch (const std::invalid_argument& error) {
    object.fail(object.get("unit"), fmt::format("object/unit: {}", error.what()));
  }
}

Material readMaterial(YamlMapReader& material) {
  const auto read = [&](const char* key, double fallback, const MaterialRange& range) {
    return material.number(key, fallback, range.min, range.max);
  };
  Material result;
  result.youngs_modulus_pa = read("youngs_modulus_pa", result.youngs_modulus_pa, kYoungsModulusRange);
  result.poisson_ratio = read("poisson_ratio", result.poisson_ratio, kPoissonRatioRange);
  result.density_kg_m3 = read("density_kg_m3", result.density_kg_m3, kDensityRange);
  for (const char* key : {"youngs_modulus_std", "youngs_modulus_std_pa"})  // the first is its earlier name
    if (material.has(key)) result.youngs_modulus_std_pa = read(key, 0.0, kYoungsModulusStdRange);
  result.damping = read("damping", result.damping, kDampingRange);
  return result;
}

/// The corners of a box, in file units. A corner may be missing if the box may be infinite.
Eigen::AlignedBox3d readBox(YamlMapReader& reader, const YAML::Node& node, const std::string& name,
                            double unit_m, bool may_be_infinite) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-kInfinity), Eigen::Vector3d::Constant(kInfinity));
  if (!may_be_infinite || reader.has("min"))
    box.min() = unit_m * Eigen::Vector3d(reader.numbers("min", 3).data());
  if (!may_be_infinite || reader.has("max"))
    box.max() = unit_m * Eigen::Vector3d(reader.numbers("max", 3).data());
  if (!(box.min().array() <= box.max().array()).all())
    reader.fail(node, fmt::format("{}: min must not exceed max", name));
  return box;
}

/// A list of maps in the object; empty if the key is missing.
YAML::Node readList(YamlMapReader& object, const char* key) {
  const YAML::Node list = object.get(key);
  if (list.IsDefined() && !list.IsSequence())
    object.fail(list, fmt::format("object/{} must be a list of maps", key));
  return list;
}

/// `object/pins`: a list of maps with name, min, max and, if they move, frame.
std::vector<PinRegion> readPins(YamlMapReader& object, const std::string& path, double unit_m,
                                Warnings* warnings) {
  std::vector<PinRegion> pins;
  const YAML::Node list = readList(object, "pins");
  for (std::size_t i = 0; list.IsDefined() && i < list.size(); ++i) {
    const std::string place = fmt::format("object/pins/{}", i);
    YamlMapReader reader(list[i], path, place + "/");
    PinRegion pin{reader.text("name"), reader.text("frame"), {}, {}};
    if (pin.name.empty()) pin.name = fmt::format("pin{}", i);
    const Eigen::AlignedBox3d box = readBox(reader, list[i], place, unit_m, false);
    pin.min = box.min();
    pin.max = box.max();
    reader.warnOfUnknown(warnings);
    pins.push_back(pin);
  }
  return pins;
}

/// `object/materials`: a list of maps with min, max and the values that differ from the object's material.
std::vector<MaterialRegion> readRegions(YamlMapReader& object, const std::string& path, double unit_m,
                                        const Material& material, Warnings* warnings) {
  std::vector<MaterialRegion> regions;
  const YAML::Node list = readList(object, "materials");
  for (std::size_t i = 0; list.IsDefined() && i < list.size(); ++i) {
    const std::string place = fmt::format("object/materials/{}", i);
    YamlMapReader reader(list[i], path, place + "/");
    const Eigen::AlignedBox3d box = readBox(reader, list[i], place, unit_m, true);
    const auto read = [&reader](const char* key, double fallback, const MaterialRange& range) {
      return reader.number(key, fallback, range.min, range.max);
    };
    regions.push_back({box.min(), box.max(),
                       read("youngs_modulus_pa", material.youngs_modulus_pa, kYoungsModulusRange),
                       read("poisson_ratio", material.poisson_ratio, kPoissonRatioRange),
                       read("density_kg_m3", material.density_kg_m3, kDensityRange)});
    reader.warnOfUnknown(warnings);
  }
  return regions;
}

/// A TetGen mesh is two files. @throw std::invalid_argument if a link leads the other one out of its folder.
void requireCompanionInside(YamlMapReader& object, const std::string& tet_mesh) {
  const std::filesystem::path file(tet_mesh);
  if (file.extension() != ".node" && file.extension() != ".ele") return;
  auto companion = file;
  companion.replace_extension(file.extension() == ".node" ? ".ele" : ".node");
  if (isInside(companion, file.parent_path())) return;
  object.fail(object.get("tet_mesh"),
              fmt::format("object/tet_mesh: {}", outsideSentence(companion, file.parent_path())));
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

ObjectDescription loadObjectDescription(const std::string& given, FileScope scope) {
  const std::string yaml_path = objectYamlAt(given);
  YamlMapReader file(parseYamlFile(yaml_path), yaml_path, "");
  YamlMapReader object = file.map("object");
  ObjectDescription description;
  description.visual_mesh = object.file("visual_mesh", scope);
  if (description.visual_mesh.empty())
    object.fail(object.get("visual_mesh"),
                "object/visual_mesh is missing; name the file of the surface mesh");
  description.cage_mesh = object.file("cage_mesh", scope);
  description.tet_mesh = object.file("tet_mesh", scope);
  if (scope == FileScope::kOwnFolder) requireCompanionInside(object, description.tet_mesh);
  description.unit_m = readUnit(object);
  if (object.has("material")) {
    YamlMapReader material = object.map("material");
    description.material = readMaterial(material);
    material.warnOfUnknown(&description.warnings);
  }
  description.material.regions =
      readRegions(object, yaml_path, description.unit_m, description.material, &description.warnings);
  if (object.has("initial_pose")) description.initial_pose = object.pose("initial_pose");
  description.pins = readPins(object, yaml_path, description.unit_m, &description.warnings);
  object.warnOfUnknown(&description.warnings);
  file.warnOfUnknown(&description.warnings);
  return description;
}

}  // namespace softbody
