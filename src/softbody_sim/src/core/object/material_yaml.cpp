#include "softbody_sim/object/material_yaml.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace softbody {
namespace {

/// A text in which values of maps are replaced and added. Places are those of yaml-cpp's marks.
class YamlText {
 public:
  YamlText(std::string text, std::string path) : text_(std::move(text)), path_(std::move(path)) {}

  const std::string& text() const { return text_; }

  /// Sets a value in the map that the keys lead to: names, or indices of lists.
  void set(const std::vector<std::string>& keys, const std::string& name, double value) {
    set(keys, name, fmt::format("{:.6g}", value));
  }
  void set(const std::vector<std::string>& keys, const std::string& name, const std::string& value) {
    const YAML::Node map = mapAt(keys);
    const YAML::Node old = map[name];
    if (old.IsDefined()) return replace(old, value);
    const auto at = static_cast<std::size_t>(map.Mark().pos);
    if (map.Style() == YAML::EmitterStyle::Flow) {
      text_.insert(at + 1, fmt::format("{}: {}{}", name, value, map.size() > 0 ? ", " : ""));
      return;
    }
    const auto first = static_cast<std::size_t>(map.begin()->first.Mark().column);
    text_.insert(static_cast<std::size_t>(map.begin()->first.Mark().pos),
                 fmt::format("{}: {}\n{}", name, value, std::string(first, ' ')));
  }

  /// Takes a key out of a map, with what separates it from the next.
  void remove(const std::vector<std::string>& keys, const std::string& name) {
    const YAML::Node map = mapAt(keys);
    for (auto entry = map.begin(); entry != map.end(); ++entry) {
      if (entry->first.Scalar() != name) continue;
      auto begin = static_cast<std::size_t>(entry->first.Mark().pos);
      std::size_t end = static_cast<std::size_t>(entry->second.Mark().pos) + entry->second.Scalar().size();
      if (map.Style() == YAML::EmitterStyle::Flow) {
        const std::size_t comma = text_.find_first_not_of(" \n", end);
        if (comma != std::string::npos && text_[comma] == ',')
          end = text_.find_first_not_of(" \n", comma + 1);
        else
          begin = text_.find_last_of(",{", begin) + (text_[text_.find_last_of(",{", begin)] == '{' ? 1 : 0);
      } else {
        end = std::min(text_.size(), text_.find('\n', end) + 1);
        end = end == 0 ? text_.size() : end;
        begin = text_.find_last_of('\n', begin) + 1;
      }
      text_.erase(begin, end - begin);
      return;
    }
  }

  bool has(const std::vector<std::string>& keys, const std::string& name) const {
    return mapAt(keys)[name].IsDefined();
  }

 private:
  YAML::Node mapAt(const std::vector<std::string>& keys) const {
    YAML::Node node = YAML::Load(text_);
    for (const std::string& key : keys) {
      const YAML::Node next = node.IsSequence() ? node[std::stoul(key)] : node[key];
      if (!next.IsDefined())
        throw std::invalid_argument(fmt::format("{}: {} is missing", path_, fmt::join(keys, "/")));
      node.reset(next);
    }
    if (!node.IsMap())
      throw std::invalid_argument(fmt::format("{}: {} is not a map", path_, fmt::join(keys, "/")));
    return node;
  }
  void replace(const YAML::Node& scalar, const std::string& value) {
    const auto at = static_cast<std::size_t>(scalar.Mark().pos);
    const std::size_t quotes = text_[at] == '"' || text_[at] == '\'' ? 2 : 0;
    text_.replace(at, scalar.Scalar().size() + quotes, value);
  }

  std::string text_, path_;
};

constexpr const char* kDeviation = "youngs_modulus_std_pa";

}  // namespace

std::string withMaterial(const std::string& text, const Material& material, const std::string& path) {
  YamlText yaml(text, path);
  const std::vector<std::string> own{"object", "material"};
  if (!yaml.has({"object"}, "material")) yaml.set({"object"}, "material", "{damping: 0.1}");
  yaml.remove(own, "youngs_modulus_std");  // its earlier name
  yaml.remove(own, kDeviation);
  if (material.youngs_modulus_std_pa) yaml.set(own, kDeviation, *material.youngs_modulus_std_pa);
  yaml.set(own, "damping", material.damping);
  yaml.set(own, "density_kg_m3", material.density_kg_m3);
  yaml.set(own, "poisson_ratio", material.poisson_ratio);
  yaml.set(own, "youngs_modulus_pa", material.youngs_modulus_pa);
  for (std::size_t k = 0; k < material.regions.size(); ++k) {
    const std::vector<std::string> region{"object", "materials", std::to_string(k)};
    yaml.set(region, "density_kg_m3", material.regions[k].density_kg_m3);
    yaml.set(region, "poisson_ratio", material.regions[k].poisson_ratio);
    yaml.set(region, "youngs_modulus_pa", material.regions[k].youngs_modulus_pa);
  }
  return yaml.text();
}

}  // namespace softbody
