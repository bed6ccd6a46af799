#include "softbody_recordings/validation/recording_facts.h"

namespace softbody::validation {

bool operator==(const CameraFacts& a, const CameraFacts& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx &&
         a.cy == b.cy;
}

}  // namespace softbody::validation
