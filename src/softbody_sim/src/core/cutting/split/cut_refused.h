#pragma once

#include <stdexcept>

namespace softbody {

/// A cut that cannot be made, and why; thrown within the core of cutting only.
struct CutRefused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace softbody
