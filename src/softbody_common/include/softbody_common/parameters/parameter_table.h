#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "softbody_common/parameters/parameter_description.h"
#include "softbody_common/parameters/parameters.h"
#include "softbody_common/time/time.h"

namespace softbody {

/// The parameters that fill a config: the one place that says their names, types, units, ranges and meanings.
/// A default is the initial value of the config's member. From a table come the reader, live changes and the
/// documentation.
///
/// Each function adds one parameter, bound to a member, and returns its description, e.g. for a default that
/// is no value: `table.text(...).initial = "(required)"`.
template <typename Config>
class ParameterTable {
 public:
  /// The following parameters are in this table of the documentation.
  void group(const std::string& name) { group_ = name; }

  ParameterDescription& number(const std::string& name, double Config::*member, const Range& range,
                               const std::string& unit, const std::string& meaning,
                               Change change = Change::kAtStart) {
    return scalar(
        described(name, "double", unit, range, meaning, change), member,
        [=](Parameters& given, double now) { return given.number(name, now, range.min, range.max); });
  }

  ParameterDescription& number(const std::string& name, int Config::*member, const Range& range,
                               const std::string& unit, const std::string& meaning,
                               Change change = Change::kAtStart) {
    const int min = static_cast<int>(range.min), max = static_cast<int>(range.max);
    return scalar(described(name, "int", unit, range, meaning, change), member,
                  [=](Parameters& given, int now) { return given.integer(name, now, min, max); });
  }

  /// A number that is no member. @param place where it is in a config.
  ParameterDescription& number(const std::string& name, const std::function<double*(Config*)>& place,
                               const Range& range, const std::string& unit, const std::string& meaning) {
    Row row{described(name, "double", unit, range, meaning, Change::kAtStart), {}, {}};
    row.read = [=](Parameters& given, Config* config) {
      double* value = place(config);
      *value = given.number(name, *value, range.min, range.max);
    };
    row.value = [=](Config config) { return ParameterValue(*place(&config)); };
    return add(std::move(row));
  }

  /// The seed of a random generator.
  ParameterDescription& seed(const std::string& name, std::uint64_t Config::*member,
                             const std::string& meaning) {
    constexpr int kMost = 1 << 30;
    Row row{described(name, "int", "", {0, kMost}, meaning, Change::kAtStart), {}, {}};
    row.read = [=](Parameters& given, Config* config) {
      const int now = static_cast<int>(config->*member);
      config->*member = static_cast<std::uint64_t>(given.integer(name, now, 0, kMost));
    };
    row.value = [=](const Config& config) { return ParameterValue(static_cast<int>(config.*member)); };
    ParameterDescription& description = add(std::move(row));
    description.allowed = "from 0";
    return description;
  }

  /// A duration that is given in seconds.
  ParameterDescription& seconds(const std::string& name, Nanoseconds Config::*member, const Range& range,
                                const std::string& meaning) {
    Row row{described(name, "double", "s", range, meaning, Change::kAtStart), {}, {}};
    row.read = [=](Parameters& given, Config* config) {
      const double now_s = softbody::seconds(config->*member);
      config->*member = nanoseconds(given.number(name, now_s, range.min, range.max));
    };
    row.value = [=](const Config& config) { return ParameterValue(softbody::seconds(config.*member)); };
    return add(std::move(row));
  }

  /// Stays as it is if it is not given. @param initial says what happens then.
  ParameterDescription& number(const std::string& name, std::optional<double> Config::*member,
                               const Range& range, const std::string& unit, const std::string& initial,
                               const std::string& meaning, Change change = Change::kAtStart) {
    Row row{described(name, "double", unit, range, meaning, change), {}, {}};
    row.description.initial = initial;
    row.read = [=](Parameters& given, Config* config) {
      if (const auto value = given.optionalNumber(name, range.min, range.max)) config->*member = value;
    };
    row.value = [=](const Config& config) {
      return config.*member ? std::optional<ParameterValue>(*(config.*member)) : std::nullopt;
    };
    return add(std::move(row));
  }

  ParameterDescription& flag(const std::string& name, bool Config::*member, const std::string& meaning) {
    return scalar(described(name, "bool", "", meaning), member,
                  [=](Parameters& given, bool now) { return given.flag(name, now); });
  }

  ParameterDescription& text(const std::string& name, std::string Config::*member,
                             const std::string& meaning) {
    return scalar(described(name, "str", "", meaning), member,
                  [=](Parameters& given, const std::string& now) { return given.text(name, now); });
  }

  /// A text that must be given and must not be empty.
  ParameterDescription& requiredText(const std::string& name, std::string Config::*member,
                                     const std::string& meaning) {
    ParameterDescription& row =
        scalar(described(name, "str", "", meaning), member,
               [=](Parameters& given, const std::string&) { return given.requiredText(name); });
    row.initial = "(required)";
    return row;
  }

  /// One of some words.
  ParameterDescription& choice(const std::string& name, std::string Config::*member,
                               const std::vector<std::string>& words, const std::string& meaning) {
    return scalar(described(name, "str", joined(words), meaning), member,
                  [=](Parameters& given, const std::string& now) { return given.choice(name, now, words); });
  }

  /// One of some words, each of which means a value.
  template <typename T>
  ParameterDescription& choice(const std::string& name, T Config::*member,
                               const std::vector<std::pair<std::string, T>>& meanings,
                               const std::string& meaning) {
    std::vector<std::string> words;
    for (const auto& [word, value] : meanings) words.push_back(word);
    const auto wordOf = [=](const T& wanted) {
      for (const auto& [word, value] : meanings)
        if (value == wanted) return word;
      return std::string();
    };
    Row row{described(name, "str", joined(words), meaning), {}, {}};
    row.read = [=](Parameters& given, Config* config) {
      const std::string chosen = given.choice(name, wordOf(config->*member), words);
      for (const auto& [word, value] : meanings)
        if (word == chosen) config->*member = value;
    };
    row.value = [=](const Config& config) { return ParameterValue(wordOf(config.*member)); };
    return add(std::move(row));
  }

  /// A list of N finite numbers. @param allowed in words.
  template <int N>
  ParameterDescription& numbers(const std::string& name, Eigen::Matrix<double, N, 1> Config::*member,
                                const std::string& unit, const std::string& allowed,
                                const std::string& meaning) {
    const auto listOf = [member](const Config& config) {
      const Eigen::Matrix<double, N, 1>& vector = config.*member;
      return std::vector<double>(vector.data(), vector.data() + N);
    };
    Row row{described(name, "list", allowed, meaning), {}, {}};
    row.description.unit = unit;
    row.description.initial = toText(listOf(Config()));
    row.read = [=](Parameters& given, Config* config) {
      const std::vector<double> list = given.numbers(name, listOf(*config));
      config->*member = Eigen::Map<const Eigen::Matrix<double, N, 1>>(list.data());
    };
    return add(std::move(row));
  }

  /// A list of texts; empty if it is not given.
  ParameterDescription& texts(const std::string& name, std::vector<std::string> Config::*member,
                              const std::string& meaning) {
    return other(name, "[]", "list", meaning,
                 [=](Parameters& given, Config* config) { config->*member = given.texts(name); });
  }

  /// A parameter that needs a reader of its own. Not live.
  ParameterDescription& other(const std::string& name, const std::string& initial, const std::string& allowed,
                              const std::string& meaning, std::function<void(Parameters&, Config*)> read) {
    Row row{described(name, "list", allowed, meaning), std::move(read), {}};
    row.description.initial = initial;
    return add(std::move(row));
  }

  /// All parameters of a part of the config, in its groups.
  template <typename Part>
  void part(Part Config::*member, const ParameterTable<Part>& table) {
    for (const auto& row : table.rows_) {
      Row mine{row.description, {}, {}};
      mine.read = [=](Parameters& given, Config* config) { row.read(given, &(config->*member)); };
      if (row.value) mine.value = [=](const Config& config) { return row.value(config.*member); };
      rows_.push_back(std::move(mine));
    }
    for (const auto& check : table.checks_)
      checks_.push_back([=](const Config& config) { check(config.*member); });
  }

  /// What values must fulfil together. @param check throws std::invalid_argument.
  void check(std::function<void(const Config&)> check) { checks_.push_back(std::move(check)); }

  /// The config with the given values. @param initial has the defaults.
  /// @throw std::invalid_argument as Parameters does.
  Config read(Parameters& given, Config initial = Config()) const {
    for (const Row& row : rows_) row.read(given, &initial);
    for (const auto& check : checks_) check(initial);
    return initial;
  }

  /// The config with some values changed while the node runs.
  /// @throw std::invalid_argument as Parameters does, and for a parameter that cannot change live.
  Config change(Parameters& given, Config now) const {
    for (const Row& row : rows_)
      if (row.description.change == Change::kLive) row.read(given, &now);
    const std::vector<std::string> others = given.unknown();
    if (!others.empty())
      throw std::invalid_argument("parameter " + others.front() + " cannot change while the node runs");
    for (const auto& check : checks_) check(now);
    return now;
  }

  /// In the order in which they were added.
  std::vector<ParameterDescription> describe(const Config& initial = Config()) const {
    std::vector<ParameterDescription> descriptions;
    for (const Row& row : rows_) {
      descriptions.push_back(row.description);
      std::string& text = descriptions.back().initial;
      if (text.empty() && row.value) text = toText(*row.value(initial));
    }
    return descriptions;
  }

  /// The values of what can change live, by name. Without those that nobody has set and that have no default.
  std::map<std::string, ParameterValue> liveValues(const Config& config) const {
    std::map<std::string, ParameterValue> values;
    for (const Row& row : rows_) {
      if (row.description.change != Change::kLive) continue;
      if (const std::optional<ParameterValue> value = row.value(config))
        values.emplace(row.description.name, *value);
    }
    return values;
  }

 private:
  template <typename Other>
  friend class ParameterTable;

  struct Row {
    ParameterDescription description;
    std::function<void(Parameters&, Config*)> read;  ///< keeps the value if the key is missing
    std::function<std::optional<ParameterValue>(const Config&)> value;  ///< none: of a list
  };

  static ParameterDescription described(const std::string& name, const std::string& type,
                                        const std::string& allowed, const std::string& meaning) {
    ParameterDescription description;
    description.name = name;
    description.type = type;
    description.allowed = allowed;
    description.meaning = meaning;
    return description;
  }

  static ParameterDescription described(const std::string& name, const std::string& type,
                                        const std::string& unit, const Range& range,
                                        const std::string& meaning, Change change) {
    ParameterDescription description = described(name, type, toText(range), meaning);
    description.unit = unit;
    description.change = change;
    description.range = range;
    return description;
  }

  template <typename T, typename Reader>
  ParameterDescription& scalar(ParameterDescription description, T Config::*member, Reader read) {
    return add({std::move(description),
                [=](Parameters& given, Config* config) { config->*member = read(given, config->*member); },
                [=](const Config& config) { return ParameterValue(config.*member); }});
  }

  ParameterDescription& add(Row row) {
    row.description.group = group_;
    rows_.push_back(std::move(row));
    return rows_.back().description;
  }

  static std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
  }

  std::string group_;
  std::vector<Row> rows_;
  std::vector<std::function<void(const Config&)>> checks_;
};

}  // namespace softbody
