#pragma once

#include <functional>
#include <optional>
#include <string>

namespace softbody {

/// Runs work in a forked process, for libraries that may crash: the caller survives.
/// @return the result, or nothing if the work threw or crashed.
/// @throw std::runtime_error if no process can be started.
std::optional<std::string> outputOfChild(const std::function<std::string()>& work);

}  // namespace softbody
