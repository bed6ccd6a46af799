#include "validation/intrinsics_checks.h"

#include <fmt/format.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace softbody::validation {
namespace {

const std::set<std::string> kDistortionModels{"", "plumb_bob", "rational_polynomial", "equidistant"};

void checkNumbers(const std::string& topic, const CameraFacts& camera, Findings* findings) {
  const auto add = [&](Severity severity, std::string sentence) {
    findings->push_back({severity, "intrinsics", topic, std::move(sentence)});
  };
  bool finite = std::isfinite(camera.fx + camera.fy + camera.cx + camera.cy);
  for (const double d : camera.distortion) finite = finite && std::isfinite(d);
  if (!finite || !(camera.fx > 0.0) || !(camera.fy > 0.0)) {
    add(Severity::kError,
        fmt::format("has fx {} and fy {}; the camera is not calibrated; set K (camera_calibration)",
                    camera.fx, camera.fy));
    return;
  }
  const double view = 2.0 * std::atan(0.5 * camera.width / camera.fx) * 180.0 / M_PI;
  if (view < 20.0 || view > 120.0) {
    add(Severity::kWarning,
        fmt::format("sees {:.0f} degrees (fx {:.1f} at {} pixels); check that K is of this resolution", view,
                    camera.fx, camera.width));
  }
  if (std::abs(camera.fx / camera.fy - 1.0) > 0.1)
    add(Severity::kWarning,
        fmt::format("has fx {:.1f} but fy {:.1f}; pixels are usually square; calibrate again", camera.fx,
                    camera.fy));
  const double off_x = std::abs(camera.cx / camera.width - 0.5),
               off_y = std::abs(camera.cy / camera.height - 0.5);
  if (off_x > 0.2 || off_y > 0.2) {
    add(Severity::kWarning,
        fmt::format("has its centre at ({:.1f}, {:.1f}) of {}x{} pixels; check that K is of this resolution",
                    camera.cx, camera.cy, camera.width, camera.height));
  }
  if (kDistortionModels.count(camera.distortion_model) == 0) {
    add(Severity::kError,
        fmt::format("has distortion model '{}'; allowed: plumb_bob, rational_polynomial, equidistant; "
                    "rectify the images first",
                    camera.distortion_model));
  }
}

void checkCamera(const StreamFacts& info, const StreamFacts& images, const std::vector<CameraFacts>& cameras,
                 Findings* findings) {
  if (cameras.empty()) return;
  const CameraFacts& camera = cameras.front();
  if (cameras.size() > 1) {
    findings->push_back(
        {Severity::kWarning, "intrinsics", info.topic,
         fmt::format("changes {} times; use one calibration for a recording", cameras.size() - 1)});
  }
  const bool one_size = images.sizes.size() == 1;
  const auto [width, height] =
      one_size ? images.sizes.begin()->first : std::make_pair(camera.width, camera.height);
  if (camera.width == width && camera.height == height) {
    checkNumbers(info.topic, camera, findings);
  } else {
    findings->push_back(
        {Severity::kError, "intrinsics", info.topic,
         fmt::format("is for {}x{} pixels, but {} has {}x{}; record the calibration of this resolution",
                     camera.width, camera.height, images.topic, width, height)});
  }
}

}  // namespace

Findings checkIntrinsics(const RecordingFacts& facts) {
  Findings findings;
  checkCamera(facts.color_info, facts.color, facts.color_cameras, &findings);
  checkCamera(facts.depth_info, facts.depth, facts.depth_cameras, &findings);
  return findings;
}

}  // namespace softbody::validation
