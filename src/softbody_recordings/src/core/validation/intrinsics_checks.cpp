#include "validation/intrinsics_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

namespace softbody::validation {
namespace {

void checkNumbers(const std::string& topic, const CameraFacts& camera, Findings* findings) {
  const auto warn = [&](std::string sentence) {
    findings->push_back({Severity::kWarning, "intrinsics", topic, std::move(sentence)});
  };
  const double view = 2.0 * std::atan(0.5 * camera.width / camera.fx) * 180.0 / M_PI;
  if (view < 20.0 || view > 120.0) {
    warn(fmt::format("sees {:.0f} degrees (fx {:.1f} at {} pixels); check that K is of this resolution", view,
                     camera.fx, camera.width));
  }
  if (std::abs(camera.fx / camera.fy - 1.0) > 0.1)
    warn(fmt::format("has fx {:.1f} but fy {:.1f}; pixels are usually square; calibrate again", camera.fx,
                     camera.fy));
  const double off_x = std::abs(camera.cx / camera.width - 0.5),
               off_y = std::abs(camera.cy / camera.height - 0.5);
  if (off_x > 0.2 || off_y > 0.2) {
    warn(fmt::format("has its centre at ({:.1f}, {:.1f}) of {}x{} pixels; check that K is of this resolution",
                     camera.cx, camera.cy, camera.width, camera.height));
  }
}

void checkCamera(const StreamFacts& info, const std::vector<CameraFacts>& cameras, Findings* findings) {
  if (cameras.empty()) return;
  if (cameras.size() > 1) {
    findings->push_back(
        {Severity::kWarning, "intrinsics", info.topic,
         fmt::format("changes {} times; use one calibration for a recording", cameras.size() - 1)});
  }
  checkNumbers(info.topic, cameras.front(), findings);
}

}  // namespace

Findings checkIntrinsics(const RecordingFacts& facts) {
  Findings findings;
  checkCamera(facts.color_info, facts.color_cameras, &findings);
  checkCamera(facts.depth_info, facts.depth_cameras, &findings);
  return findings;
}

}  // namespace softbody::validation
