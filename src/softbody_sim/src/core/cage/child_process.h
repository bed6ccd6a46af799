#pragma once

#include <functional>
#include <optional>
#include <string>

namespace softbody {

/// Runs work of a library that may crash in a forked process of its own, so that a crash is an answer.
/// @return what the work returned, or nothing if it threw or crashed.
/// @throw std::runtime_error if there can be no further process.
std::optional<std::string> outputOfChild(const std::function<std::string()>& work);

}  // namespace softbody
