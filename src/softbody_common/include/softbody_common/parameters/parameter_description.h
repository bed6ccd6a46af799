#pragma once

#include <string>
#include <variant>
#include <vector>

namespace softbody {

/// When a parameter may get another value.
enum class Change {
  kAtStart,  ///< only before the node starts
  kLive      ///< also while the node runs; it counts from the next frame on
};

/// The allowed values of a number, both ends included.
struct Range {
  double min, max;
};

/// What one number, word or switch of a node can be.
using ParameterValue = std::variant<bool, int, double, std::string>;

/// A parameter as its user sees it.
struct ParameterDescription {
  std::string name;
  std::string type;     ///< bool, int, double, str, list
  std::string initial;  ///< the default, as text
  std::string unit;     ///< empty: none
  std::string allowed;  ///< e.g. "0 to 1" or "pd, fem"; empty: every value of the type
  std::string meaning;  ///< Markdown; links start in the folder of the group's page
  Change change = Change::kAtStart;
  std::string group;         ///< which table of the documentation has it
  Range range = {0.0, 0.0};  ///< of int and double
};

/// As people write it: 0.5, 1e-6, true, pd; an empty text is "(none)".
std::string toText(const ParameterValue& value);
std::string toText(const Range& range);
/// E.g. "[0, 0, 1]".
std::string toText(const std::vector<double>& numbers);

/// A Markdown table with the default, unit, range and meaning of each parameter. It ends with a line break.
std::string markdownTable(const std::vector<ParameterDescription>& parameters);

/// A meaning without the marks of Markdown: links become their text.
std::string withoutMarkdown(const std::string& meaning);

}  // namespace softbody
