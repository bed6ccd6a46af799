#pragma once

#include <string>

namespace softbody::evaluation {

/// What a figure measures, in one sentence. @param name as figures() gives it.
std::string meaningOf(const std::string& name);

}  // namespace softbody::evaluation
