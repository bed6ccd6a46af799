#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

namespace softbody {

/// Runs a program with one argument in a process of its own, for libraries that may crash. The program reads
/// `input` on stdin; its stderr is discarded. Safe in a process with threads: the process is spawned, never
/// forked.
/// @return its stdout, or nothing if it failed or crashed.
/// @throw std::system_error if it cannot be started or does not end within the time limit; it is then killed.
std::optional<std::string> outputOfProgram(const std::filesystem::path& program, const std::string& argument,
                                           const std::string& input, std::chrono::seconds time_limit);

}  // namespace softbody
