#pragma once

#include <yaml-cpp/node/node.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace softbody {

/// The parameters of one node as a YAML map, from a ROS namespace (ros_parameters.h) or from a file. Every
/// reader throws std::invalid_argument with the full key, the value and the allowed values.
class Parameters {
 public:
  /// @param prefix of keys in messages, e.g. "/softbody/simulator/".
  explicit Parameters(YAML::Node values = YAML::Node(), std::string prefix = "");

  double number(const std::string& key, double fallback, double min, double max);
  /// Empty if the key is missing.
  std::optional<double> optionalNumber(const std::string& key, double min, double max);
  int integer(const std::string& key, int fallback, int min, int max);
  bool flag(const std::string& key, bool fallback);
  std::string text(const std::string& key, const std::string& fallback);
  /// One of the allowed words.
  std::string choice(const std::string& key, const std::string& fallback,
                     const std::vector<std::string>& allowed);
  std::string requiredText(const std::string& key);
  /// A list of finite numbers, of the same length as the fallback.
  std::vector<double> numbers(const std::string& key, const std::vector<double>& fallback);

  /// A list of texts, none of them empty; empty if the key is missing.
  std::vector<std::string> texts(const std::string& key);
  /// A list of maps; empty if the key is missing.
  std::vector<Parameters> maps(const std::string& key);

  /// Full keys that were given but never read. The caller should warn about them.
  std::vector<std::string> unknown() const;

 private:
  template <typename T>
  T get(const std::string& key, const T& fallback, const char* expected);

  YAML::Node values_;
  std::string prefix_;
  std::set<std::string> known_;
};

}  // namespace softbody
