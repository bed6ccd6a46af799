#include "softbody_scanning/scan/checked_scan.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <stdexcept>

#include "scan/agreement.h"
#include "softbody_scanning/fusion/depth_view.h"

namespace softbody::scanning {
namespace {

constexpr double kMostLeftOut = 0.2;  // of the frames: with more, it is not known which of them are right
constexpr double kLeastSeen = 0.5;    // of the surface: with less, most of the model would be invented

/// The times of a recording in which frames disagree.
std::string timesOf(const std::vector<KeyFrame>& frames, const std::vector<bool>& wrong) {
  const auto first = std::find(wrong.begin(), wrong.end(), true) - wrong.begin();
  const auto last = wrong.rend() - std::find(wrong.rbegin(), wrong.rend(), true) - 1;
  const auto seconds = [&](std::ptrdiff_t i) {
    return 1e-9 * static_cast<double>(frames[static_cast<std::size_t>(i)].stamp - frames.front().stamp);
  };
  return fmt::format("{:.1f} s to {:.1f} s", seconds(first), seconds(last));
}

/// Removes the frames that do not agree. @return how many. @throw std::invalid_argument if they are too many.
int removeDisagreeing(const ScannedBody& body, std::vector<PosedRecording>* recordings) {
  const std::vector<bool> wrong =
      disagreeing(agreementWith(body.mesh, body.frames, measureInverseDepthNoise(body.frames)));
  const auto count = static_cast<int>(std::count(wrong.begin(), wrong.end(), true));
  std::size_t next = 0;
  for (PosedRecording& recording : *recordings) {
    const auto begin = wrong.begin() + static_cast<std::ptrdiff_t>(next);
    const std::vector<bool> of_recording(begin, begin + static_cast<std::ptrdiff_t>(recording.frames.size()));
    next += recording.frames.size();
    const auto here = std::count(of_recording.begin(), of_recording.end(), true);
    if (static_cast<double>(here) > kMostLeftOut * static_cast<double>(of_recording.size()))
      throw std::invalid_argument(
          fmt::format("{}: the object moved or changed its shape: {} of {} frames do not agree with the "
                      "others (from {}); "
                      "record it again and touch neither the object nor what it stands on",
                      recording.name, here, of_recording.size(), timesOf(recording.frames, of_recording)));
    std::vector<KeyFrame> kept;
    for (std::size_t i = 0; i < of_recording.size(); ++i)
      if (!of_recording[i]) kept.push_back(std::move(recording.frames[i]));
    recording.frames = std::move(kept);
  }
  return count;
}

double shareSeen(const ScannedBody& body, bool with_underside) {
  double all = 0.0, seen = 0.0;
  for (const auto& t : body.mesh.triangles.rowwise()) {
    const Eigen::Vector3d a = body.mesh.vertices.row(t[0]), b = body.mesh.vertices.row(t[1]),
                          c = body.mesh.vertices.row(t[2]);
    if (!with_underside && !(std::max({a.z(), b.z(), c.z()}) > 0.0)) continue;
    const double area = (b - a).cross(c - a).norm();
    all += area;
    if (isSeen((body.seen[t[0]] + body.seen[t[1]] + body.seen[t[2]]) / 3.0f)) seen += area;
  }
  return all > 0.0 ? seen / all : 0.0;
}

}  // namespace

CheckedScan scanAndCheck(std::vector<PosedRecording> recordings, const ScanSettings& settings) {
  CheckedScan scan;
  scan.body = scanBody(recordings, settings);
  scan.left_out = removeDisagreeing(scan.body, &recordings);
  if (scan.left_out > 0) scan.body = scanBody(std::move(recordings), settings);
  scan.seen_share = shareSeen(scan.body, true);
  scan.upper_seen_share = shareSeen(scan.body, false);
  if (scan.upper_seen_share < kLeastSeen)
    throw std::invalid_argument(fmt::format(
        "too few views: only {:.0f} % of the object's surface was seen; walk once round it, high and "
        "low, and keep it in the image",
        1e2 * scan.upper_seen_share));
  return scan;
}

}  // namespace softbody::scanning
