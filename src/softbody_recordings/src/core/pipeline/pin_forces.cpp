#include "softbody_recordings/pipeline/pin_forces.h"

#include <utility>

#include "softbody_common/time/time.h"

namespace softbody {
namespace {

constexpr double kPeriod_s = 0.2;

std::vector<int> verticesOf(const std::vector<Pin>& pins) {
  std::vector<int> vertices;
  for (const Pin& pin : pins) vertices.push_back(pin.vertex);
  return vertices;
}

}  // namespace

bool PinForces::areDue(const std::vector<Pin>& pins, Nanoseconds stamp) const {
  const double since_s = seconds(stamp - stamp_);
  return !pins.empty() && (since_s < 0.0 || since_s >= kPeriod_s || verticesOf(pins) != held_);
}

void PinForces::set(const std::vector<Pin>& pins, Nanoseconds stamp, std::vector<Wrench> forces) {
  stamp_ = stamp;
  held_ = verticesOf(pins);
  forces_ = std::move(forces);
}

void PinForces::applyTo(std::vector<Wrench>* pins) const {
  if (pins->size() == forces_.size()) *pins = forces_;
}

}  // namespace softbody
