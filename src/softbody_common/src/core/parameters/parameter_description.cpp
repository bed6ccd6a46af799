#include "softbody_common/parameters/parameter_description.h"

#include <fmt/format.h>

#include <regex>

namespace softbody {
namespace {

/// Short, and without the zeros and the plus of an exponent: 1e-6 for 1e-06.
std::string numberText(double number) {
  static const std::regex exponent("e(-?)\\+?0*([1-9])");
  const std::string brief = fmt::format("{:g}", number);
  const bool exact = std::stod(brief) == number;
  return std::regex_replace(exact ? brief : fmt::format("{:.15g}", number), exponent, "e$1$2");
}

struct TextOf {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(int value) const { return std::to_string(value); }
  std::string operator()(double value) const { return numberText(value); }
  std::string operator()(const std::string& value) const { return value.empty() ? "(none)" : value; }
};

}  // namespace

std::string toText(const ParameterValue& value) { return std::visit(TextOf(), value); }

std::string toText(const Range& range) {
  return fmt::format("{} to {}", numberText(range.min), numberText(range.max));
}

std::string toText(const std::vector<double>& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "" : ", ") + numberText(number);
  return "[" + text + "]";
}

std::string markdownTable(const std::vector<ParameterDescription>& parameters) {
  std::string table =
      "| parameter | default | unit | range | live | meaning |\n"
      "|---|---|---|---|---|---|\n";
  const auto cell = [](const std::string& text) { return text.empty() ? "" : " " + text; };
  for (const ParameterDescription& p : parameters) {
    table += fmt::format("| {} |{} |{} |{} |{} |{} |\n", p.name, cell(p.initial), cell(p.unit),
                         cell(p.allowed), p.change == Change::kLive ? " yes" : "", cell(p.meaning));
  }
  return table;
}

std::string withoutMarkdown(const std::string& meaning) {
  static const std::regex link("\\[([^\\]]*)\\]\\([^)]*\\)"), mark("`");
  return std::regex_replace(std::regex_replace(meaning, link, "$1"), mark, "");
}

}  // namespace softbody
