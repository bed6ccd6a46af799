#include "softbody_common/parameters/parameters.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace softbody {
namespace {

template <typename Number>
Number inRange(const std::string& name, Number value, Number min, Number max) {
  // Negated to refuse NaN too.
  if (!(value >= min && value <= max)) {
    throw std::invalid_argument(fmt::format("parameter {} is {}; allowed: {} to {}", name, value, min, max));
  }
  return value;
}

}  // namespace

Parameters::Parameters(YAML::Node values, std::string prefix) : values_(values), prefix_(std::move(prefix)) {
  if (values_.IsDefined() && !values_.IsNull() && !values_.IsMap()) {
    throw std::invalid_argument(fmt::format("parameters {} must be a map of keys and values", prefix_));
  }
}

template <typename T>
T Parameters::get(const std::string& key, const T& fallback, const char* expected) {
  known_.insert(key);
  const YAML::Node value = values_.IsMap() ? values_[key] : YAML::Node(YAML::NodeType::Undefined);
  if (!value.IsDefined()) return fallback;
  try {
    return value.as<T>();
  } catch (const YAML::Exception&) {
    throw std::invalid_argument(
        fmt::format("parameter {}{} is '{}'; it must be {}", prefix_, key, YAML::Dump(value), expected));
  }
}

double Parameters::number(const std::string& key, double fallback, double min, double max) {
  return inRange(prefix_ + key, get(key, fallback, "a number"), min, max);
}

std::optional<double> Parameters::optionalNumber(const std::string& key, double min, double max) {
  known_.insert(key);
  if (!values_.IsMap() || !values_[key].IsDefined()) return std::nullopt;
  return number(key, min, min, max);
}

int Parameters::integer(const std::string& key, int fallback, int min, int max) {
  return inRange(prefix_ + key, get(key, fallback, "a whole number"), min, max);
}

bool Parameters::flag(const std::string& key, bool fallback) { return get(key, fallback, "true or false"); }

std::string Parameters::text(const std::string& key, const std::string& fallback) {
  return get(key, fallback, "a text");
}

std::string Parameters::choice(const std::string& key, const std::string& fallback,
                               const std::vector<std::string>& allowed) {
  std::string value = text(key, fallback);
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
    throw std::invalid_argument(
        fmt::format("parameter {}{} is '{}'; allowed: {}", prefix_, key, value, fmt::join(allowed, ", ")));
  }
  return value;
}

std::string Parameters::requiredText(const std::string& key) {
  std::string value = text(key, "");
  if (value.empty()) throw std::invalid_argument(fmt::format("parameter {}{} is missing", prefix_, key));
  return value;
}

std::vector<double> Parameters::numbers(const std::string& key, const std::vector<double>& fallback) {
  std::vector<double> values = get(key, fallback, "a list of numbers");
  const bool finite = std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
  if (values.size() != fallback.size() || !finite) {
    throw std::invalid_argument(fmt::format("parameter {}{} is [{}]; it must be {} finite numbers", prefix_,
                                            key, fmt::join(values, ", "), fallback.size()));
  }
  return values;
}

std::vector<std::string> Parameters::texts(const std::string& key) {
  std::vector<std::string> values = get(key, std::vector<std::string>(), "a list of texts");
  if (std::find(values.begin(), values.end(), "") != values.end()) {
    throw std::invalid_argument(
        fmt::format("parameter {}{} is [{}]; none may be empty", prefix_, key, fmt::join(values, ", ")));
  }
  return values;
}

std::vector<Parameters> Parameters::maps(const std::string& key) {
  std::vector<Parameters> maps;
  const auto values = get(key, YAML::Node(YAML::NodeType::Sequence), "a list of maps");
  if (!values.IsSequence()) {
    throw std::invalid_argument(
        fmt::format("parameter {}{} is '{}'; it must be a list of maps", prefix_, key, YAML::Dump(values)));
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    maps.emplace_back(values[i], fmt::format("{}{}/{}/", prefix_, key, i));
  return maps;
}

std::vector<std::string> Parameters::unknown() const {
  std::vector<std::string> keys;
  if (!values_.IsMap()) return keys;
  for (const auto& entry : values_) {
    const auto key = entry.first.as<std::string>();
    if (known_.count(key) == 0) keys.push_back(prefix_ + key);
  }
  return keys;
}

}  // namespace softbody
