#include "search_report/search_sentence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "agreement/body_edges.h"
#include "agreement/confinement.h"
#include "agreement/pose_cost.h"

namespace softbody {
namespace {

constexpr char kPoseAdvice[] =
    "or give a rough pose: initial_pose in the object YAML, or pose_marker:=true in rviz";
constexpr char kOtherPoseAdvice[] =
    "or correct the rough pose (initial_pose in the object YAML, or pose_marker:=true in rviz), or set "
    "search: anywhere";

const char* poseAdvice(const SearchReport& report) {
  return report.near_pose ? kOtherPoseAdvice : kPoseAdvice;
}

/// "200 x 100 x 40 mm", or in metres if the largest has ten of them.
std::string sizeText(const Eigen::Vector3d& size_m) {
  const bool large = size_m.maxCoeff() >= 10.0;
  const Eigen::Vector3d size = size_m * (large ? 1.0 : 1e3);
  return fmt::format("{:.3g} x {:.3g} x {:.3g} {}", size.x(), size.y(), size.z(), large ? "m" : "mm");
}

int percent(double share) { return static_cast<int>(std::lround(100.0 * share)); }

/// "10 % larger", "4 times smaller".
std::string scaleText(double factor) {
  const bool larger = factor > 1.0;
  const double times = larger ? factor : 1.0 / factor;
  if (times < 2.0)
    return fmt::format("{} % {}", percent(std::abs(factor - 1.0)), larger ? "larger" : "smaller");
  return fmt::format("{:.4g} times {}", times, larger ? "larger" : "smaller");
}

std::string candidateText(const SearchReport& report) {
  if (report.part_m.maxCoeff() <= 0.0) return fmt::format("the mesh has {}", sizeText(report.body_m));
  return fmt::format("the best candidate has {} at {:.2f} m, the mesh {}", sizeText(report.part_m),
                     report.part_distance_m, sizeText(report.body_m));
}

std::string noDepth(const SearchReport& report) {
  return fmt::format(
      "{:.1f} % of the pixels have a depth in the range from min_depth_m to max_depth_m; check the distance, "
      "the depth image, and its unit (depth_scale)",
      100.0 * report.depth_share);
}

std::string otherScale(const SearchReport& report) {
  return fmt::format(
      "{}; a mesh {} would fit. Check the mesh's unit and size with a ruler (prepare_model --unit, "
      "--length), "
      "and the unit of the depth image (depth_scale)",
      candidateText(report), scaleText(*report.fitting_scale));
}

std::string noCandidate(const SearchReport& report) {
  if (report.part_m.maxCoeff() <= 0.0)
    return fmt::format(
        "nothing stands free before a table or wall (the mesh has {}; depth from {:.2f} to {:.2f} m). Move "
        "the body into the view, check the mesh's unit (prepare_model --unit), {}",
        sizeText(report.body_m), report.nearest_m, report.farthest_m, kPoseAdvice);
  return fmt::format(
      "nothing of its size stands free: {}. Move the body away from what it touches, check the mesh's unit "
      "(prepare_model --unit) and the depth's (depth_scale), {}",
      candidateText(report), kPoseAdvice);
}

/// What the image shows instead of the body, and what to do.
std::string disagreement(const SearchReport& report) {
  if (report.part_at_border) return "It reaches the border of the image: move it into the view";
  if (report.hidden > kLargestCost)
    return fmt::format("Something is before {} % of it: take it away", percent(report.hidden));
  if (report.continuing > kLargestShareWithoutEdge)
    return fmt::format(
        "The surface goes on beyond {} % of the outline: it touches something, it is bent, or the mesh is "
        "too small. Tracking starts when it stands free near its rest shape",
        percent(report.continuing));
  return "It is bent, or another object: tracking starts when it is near the rest shape of the mesh";
}

std::string highCost(const SearchReport& report) {
  return fmt::format(
      "{}; its disagreement is {} %, allowed: {} %. {} % of the mesh's pixels agree, at {} % the camera sees "
      "through it, at {} % something is nearer; the median difference is {:.1f} mm. {}, {}",
      candidateText(report), percent(report.cost), percent(kLargestCost), percent(report.agreeing),
      percent(report.farther), percent(report.nearer), 1e3 * report.difference_m, disagreement(report),
      poseAdvice(report));
}

std::string notConfined(const SearchReport& report) {
  return fmt::format(
      "{}; {} % of its pixels agree, but only {} % of the edges that would confine it are seen (needed: {} "
      "%): it lies in a larger surface, most of it is hidden, or the mesh is too small. Move the body away "
      "from what it touches, compare the mesh with a ruler, {}",
      candidateText(report), percent(report.agreeing), percent(report.confined), percent(kLeastConfinement),
      poseAdvice(report));
}

std::string noEdge(const SearchReport& report) {
  return fmt::format(
      "{}; {} % of its pixels agree, but at {} % of the outline (allowed: {} %) depth runs straight on: it "
      "lies in a larger surface, or the mesh is too small. Move the body away from it, compare the mesh with "
      "a ruler, {}",
      candidateText(report), percent(report.agreeing), percent(report.without_edge),
      percent(kLargestShareWithoutEdge), poseAdvice(report));
}

std::string elsewhere(const SearchReport& report) {
  return fmt::format(
      "{}; the nearest pose that fits is {:.0f} mm and {:.0f} degrees from the rough pose, more than three "
      "standard deviations (initial_pose_std_m, initial_pose_std_deg). Move the body there, {}",
      candidateText(report), 1e3 * report.shift_m, report.turn_rad * 180.0 / M_PI, poseAdvice(report));
}

/// What the candidates of a body with a picture lack.
std::string notSeen(const SearchReport& report) {
  if (report.several_places)
    return fmt::format("the object's picture is seen in several places. Take the other one away, {}",
                       kPoseAdvice);
  const std::size_t others = report.pictured - report.refused_by_depth - report.refused_by_picture;
  return fmt::format(
      "{}. Of {} poses, {} do not agree with the depth or may slide; at {} something else than the object's "
      "picture is seen; {} neither show it clearly nor stand free. Move the body into the view, or away from "
      "what hides it, compare the picture with the body, {}",
      candidateText(report), report.pictured, report.refused_by_depth, report.refused_by_picture, others,
      kPoseAdvice);
}

}  // namespace

std::string whyNotFound(const SearchReport& report) {
  if (report.found) return {};
  const auto why = [&] {
    if (report.depth_share == 0.0) return noDepth(report);
    if (report.fitting_scale) return otherScale(report);
    if (report.several_places || report.refused_by_picture > 0) return notSeen(report);
    if (report.cost >= 1.0 || (!report.near_pose && !report.part_fits && report.cost > kLargestCost))
      return noCandidate(report);
    if (report.cost > kLargestCost) return highCost(report);
    if (report.confined < kLeastConfinement) return notConfined(report);
    if (!report.near_pose && report.without_edge > kLargestShareWithoutEdge) return noEdge(report);
    if (report.outside) return elsewhere(report);
    return fmt::format("{}; {} % of its pixels agree, but its colours or features are not those of the body",
                       candidateText(report), percent(report.agreeing));
  };
  return "the body was not found: " + why();
}

}  // namespace softbody
