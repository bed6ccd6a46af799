#pragma once

#include <string>

namespace softbody::evaluation {

/// What a metric measures, in one sentence. @param name as metrics() gives it.
std::string meaningOf(const std::string& name);

}  // namespace softbody::evaluation
