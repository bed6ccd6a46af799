#pragma once

#include <stdexcept>

namespace softbody {

/// Thrown for a cut that cannot be made, with the reason. Never leaves cutSurface.
struct CutRefused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace softbody
