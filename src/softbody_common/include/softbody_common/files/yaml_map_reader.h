#pragma once

#include <yaml-cpp/node/node.h>

#include <Eigen/Geometry>
#include <set>
#include <string>
#include <vector>

#include "softbody_common/files/input_file.h"

namespace softbody {

/// @throw std::invalid_argument with the file, and the line of a YAML error.
YAML::Node parseYamlFile(const std::string& path);

/// Reads one map of a YAML file that a user wrote. Every reader throws std::invalid_argument with file, line,
/// key, value and the allowed values.
class YamlMapReader {
 public:
  /// @param prefix of keys in messages, e.g. "object/".
  YamlMapReader(const YAML::Node& map, std::string path, std::string prefix);

  bool has(const std::string& key);
  /// The node of a key; undefined if the key is missing.
  YAML::Node get(const std::string& key);

  /// Empty if the key is missing.
  std::string text(const std::string& key);
  double number(const std::string& key, double fallback, double min, double max);
  double requiredNumber(const std::string& key, double min, double max);
  int requiredInteger(const std::string& key, int min, int max);
  std::vector<double> numbers(const std::string& key, std::size_t count);
  /// [x, y, z, qx, qy, qz, qw]; the quaternion must have length 1 within 0.01.
  Eigen::Isometry3d pose(const std::string& key);
  /// An existing file, relative to the YAML; empty if the key is missing.
  std::string file(const std::string& key, FileScope scope = FileScope::kOwnFolder);
  YamlMapReader map(const std::string& key);

  void warnOfUnknown(std::vector<std::string>* warnings) const;
  [[noreturn]] void fail(const YAML::Node& node, const std::string& what) const;
  /// A node's text as the user wrote it, or "missing".
  static std::string shown(const YAML::Node& node);

 private:
  YAML::Node map_;
  std::string path_;
  std::string prefix_;
  std::set<std::string> known_;
};

}  // namespace softbody
