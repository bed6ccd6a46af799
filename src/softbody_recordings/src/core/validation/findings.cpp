#include "softbody_recordings/validation/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace softbody::validation {
namespace {

const char* name(Severity severity) { return severity == Severity::kError ? "error" : "warning"; }

std::ptrdiff_t countOf(const Findings& findings, Severity severity) {
  return std::count_if(findings.begin(), findings.end(),
                       [severity](const Finding& finding) { return finding.severity == severity; });
}

nlohmann::json toJson(const StreamFacts& stream) {
  nlohmann::json document = {
      {"topic", stream.topic}, {"type", stream.type}, {"messages", stream.stamps.size()}};
  if (stream.encodings.size() == 1) document["encoding"] = stream.encodings.begin()->first;
  if (stream.sizes.size() == 1)
    document["size_px"] = {stream.sizes.begin()->first.first, stream.sizes.begin()->first.second};
  return document;
}

}  // namespace

bool usable(const Findings& findings) { return countOf(findings, Severity::kError) == 0; }

std::string toText(const RecordingFacts& facts, const Findings& findings) {
  std::string text;
  for (const Finding& finding : findings) {
    text += fmt::format("{}: {}{}{}\n", name(finding.severity), finding.topic,
                        finding.topic.empty() ? "" : " ", finding.sentence);
  }
  if (!facts.trial)
    text +=
        "not checked without --object FILE: the unit of depth, and whether the first frame shows the body\n";
  return text + fmt::format("{}: {}, {} errors, {} warnings, {} colour and {} depth images\n", facts.path,
                            usable(findings) ? "usable" : "not usable", countOf(findings, Severity::kError),
                            countOf(findings, Severity::kWarning), facts.color.stamps.size(),
                            facts.depth.stamps.size());
}

nlohmann::json toJson(const RecordingFacts& facts, const Findings& findings) {
  nlohmann::json list = nlohmann::json::array();
  for (const Finding& finding : findings) {
    list.push_back({{"severity", name(finding.severity)},
                    {"check", finding.check},
                    {"topic", finding.topic},
                    {"sentence", finding.sentence}});
  }
  return {{"bag", facts.path},
          {"usable", usable(findings)},
          {"findings", list},
          {"streams",
           {toJson(facts.color), toJson(facts.color_info), toJson(facts.depth), toJson(facts.depth_info)}}};
}

}  // namespace softbody::validation
