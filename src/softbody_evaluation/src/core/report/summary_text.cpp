#include "softbody_evaluation/report/summary_text.h"

#include <fmt/format.h>

#include <cmath>

#include "softbody_evaluation/report/verdict.h"

namespace softbody::evaluation {
namespace {

constexpr char kMeanError[] = "vertex error, mean";  // has no limits, but is asked for first

std::string row(const Figure& figure) {
  const std::string value = std::isnan(figure.value) ? "-" : fmt::format("{:.4g}", figure.value);
  const Level level = levelOf(figure.name, figure.value);
  const std::string limits = limitsOf(figure.name);
  const std::string mark = level == Level::kGood ? "" : fmt::format("   <- {}", toText(level));
  return fmt::format("  {:<50} {:>8} {:<2}  {}{}\n", figure.name, value, figure.unit, limits, mark);
}

}  // namespace

std::string verdictText(const Report& report) {
  const Verdict verdict = judge(report);
  std::string text = "verdict: " + toText(verdict.level) + "\n";
  if (!verdict.premise.empty()) text += "  " + verdict.premise + "\n";
  for (const Finding& finding : verdict.findings) text += "  - " + finding.sentence + "\n";
  for (const std::string& limit : verdict.limits) text += "  " + limit + "\n";
  for (const std::string& note : report.notes) text += "  note: " + note + "\n";
  return text;
}

std::string summaryTable(const Report& report) {
  std::string text;
  for (const Figure& figure : figures(report)) {
    if (figure.name == kMeanError || !limitsOf(figure.name).empty()) text += row(figure);
  }
  return text;
}

}  // namespace softbody::evaluation
