#pragma once

#include <string>
#include <vector>

namespace softbody {

/// Sentences for the user: what was ignored, what was repaired, what does not fit.
using Warnings = std::vector<std::string>;

}  // namespace softbody
