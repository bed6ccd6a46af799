#include "report/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "report/units.h"

namespace softbody::evaluation {
namespace {

// The tracker counts two poses as different if they are turned by more.
constexpr double kSameTurn_deg = 20.0;

/// The limits of a metric's absolute value, and what it means to exceed them.
struct Limit {
  const char* metric;
  bool low_is_bad;
  double suspect, wrong;  ///< kNothing: no such limit
  const char* advice;
};

constexpr Limit kLimits[] = {
    {"frames answered", true, 95.0, 50.0, "Frames are missing in the input: run validate_bag."},
    {"frames tracking", true, 95.0, 50.0,
     "The tracker lost the body or was not sure of it: look at the film, and at the reasons in the log."},
    {"vertex error, p95", false, 10.0, 30.0, "A part of the mesh is far from its true place."},
    {"visible vertices, mean", false, 2.5, 10.0, "The visible side does not follow the body."},
    {"hidden vertices, mean", false, 5.0, 20.0,
     "The hidden side is wrong: check the material, and what holds the body."},
    {"visible vertices within their 90 % bound", true, 60.0, kNothing,
     "The predicted errors are too small: do not trust the standard deviations."},
    {"frames with the true number of pieces", true, 90.0, 50.0, "A cut is missing, or was made too late."},
    {"cut surface from the true one, mean", false, 3.0, 10.0, "The cut is in the wrong place."},
    {"silhouette IoU, mean", true, 0.95, 0.80, "The outline of the mesh is not the outline of the body."},
    {"silhouette IoU against depth, worst", true, 0.40, kNothing,
     "In at least one frame the mesh is beside the body, or the body is covered."},
    {"depth residual, median", false, 3.0, 10.0,
     "Most of the visible surface is not where the camera measures it."},
    {"depth residual, p95", false, 20.0, 50.0,
     "A part of the mesh is not on the body: the model has the wrong size, the images have wrong stamps, or "
     "the mesh followed another object."},
    {"depth within 15 mm, covered pixels are misses", true, 70.0, 20.0,
     "The body is covered, or the mesh is behind the measured surface."},
    {"volume change, mean", false, 3.0, 10.0, "The model probably has the wrong size."},
    {"volume change, largest", false, 10.0, 25.0, "In some frames the mesh was crushed or inflated."},
};

const Limit* findLimit(const std::string& metric) {
  const auto limit = std::find_if(std::begin(kLimits), std::end(kLimits),
                                  [&](const Limit& candidate) { return metric == candidate.metric; });
  return limit == std::end(kLimits) ? nullptr : limit;
}

/// Whether the value is on the bad side of a limit. False if one of them is not a number.
bool exceeds(const Limit& limit, double value, double bound) {
  return limit.low_is_bad ? value < bound : std::abs(value) > bound;
}

std::string sentenceOf(const Metric& metric, const Limit& limit, Level level) {
  const double bound = level == Level::kWrong ? limit.wrong : limit.suspect;
  return fmt::format("{} is {:.4g}{}{}; a result {} {:g} is {}. {}", metric.name, metric.value,
                     metric.unit.empty() ? "" : " ", metric.unit, limit.low_is_bad ? "below" : "above", bound,
                     toText(level), limit.advice);
}

/// What a pose that looks like others means for the metrics.
std::string premiseOf(const AlikePoses& alike) {
  const std::string taken = fmt::format("The tracker took one of {} poses that look alike", alike.poses);
  if (!alike.compared)
    return taken + ". Whether it is the true pose is not known: the depth is the same in all of them.";
  const double turn = kDegrees * alike.turn_rad;
  if (!alike.same_shape) {
    return taken + fmt::format(
                       ", but the mesh does not look the same in it: it is turned by {:.0f} degrees from the "
                       "true pose, and the errors of the vertices come from that. Give a rough initial_pose.",
                       turn);
  }
  if (turn < kSameTurn_deg) return taken + ": the true one.";
  return taken +
         fmt::format(
             ". It is turned by {:.0f} degrees from the true pose, and the mesh looks the same in both. "
             "So each vertex is compared with the place in the truth that looks the same.",
             turn);
}

}  // namespace

std::string toText(Level level) {
  return level == Level::kGood ? "good" : level == Level::kSuspect ? "suspect" : "wrong";
}

Level levelOf(const std::string& metric, double value) {
  const Limit* limit = findLimit(metric);
  if (limit == nullptr) return Level::kGood;
  if (exceeds(*limit, value, limit->wrong)) return Level::kWrong;
  return exceeds(*limit, value, limit->suspect) ? Level::kSuspect : Level::kGood;
}

std::string limitsOf(const std::string& metric) {
  const Limit* limit = findLimit(metric);
  if (limit == nullptr) return {};
  const char* side = limit->low_is_bad ? "below" : "above";
  const std::string suspect = fmt::format("suspect {} {:g}", side, limit->suspect);
  return std::isnan(limit->wrong) ? suspect : suspect + fmt::format(", wrong {} {:g}", side, limit->wrong);
}

Verdict judge(const Report& report) {
  Verdict verdict;
  if (report.alike) verdict.premise = premiseOf(*report.alike);
  for (const Metric& metric : metrics(report)) {
    const Level level = levelOf(metric.name, metric.value);
    if (level != Level::kGood)
      verdict.findings.push_back({level, sentenceOf(metric, *findLimit(metric.name), level)});
  }
  const bool has_depth = report.residual && !std::isnan(report.residual->within_15mm_of_measured);
  if (!report.vertex_error && !has_depth) {
    verdict.findings.push_back({Level::kSuspect,
                                "The result was compared with nothing: give --truth, or --recording with "
                                "depth images."});
  } else if (!report.vertex_error) {
    verdict.limits.push_back(
        "Without truth, hidden parts and sliding along the surface are not measured. Look at the film: the "
        "lines must stay on the same texture.");
  }
  std::stable_sort(verdict.findings.begin(), verdict.findings.end(),
                   [](const Finding& a, const Finding& b) { return a.level > b.level; });
  if (!verdict.findings.empty()) verdict.level = verdict.findings.front().level;
  return verdict;
}

nlohmann::json toJson(const Verdict& verdict) {
  nlohmann::json reasons = nlohmann::json::array();
  for (const Finding& finding : verdict.findings) reasons.push_back(finding.sentence);
  nlohmann::json document = {
      {"level", toText(verdict.level)}, {"reasons", reasons}, {"limits", verdict.limits}};
  if (!verdict.premise.empty()) document["premise"] = verdict.premise;
  return document;
}

}  // namespace softbody::evaluation
