#pragma once

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

namespace softbody {

/// Runs a tool: reads the command line and calls `work`, which returns the exit code. Prints exceptions of
/// the work on stderr.
/// @return 0: done; 1: the data could not be processed; 2: wrong usage.
template <typename Work>
int runTool(CLI::App* app, int argc, char** argv, const Work& work) {
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app->exit(error) == 0 ? 0 : 2;
  }
  try {
    return work();
  } catch (const std::exception& error) {
    const std::string tool = std::filesystem::path(argv[0]).filename().string();
    std::fprintf(stderr, "%s: %s\n", tool.c_str(), error.what());
    return 1;
  }
}

/// Checks two files of a command line, in the callback of a CLI::App.
/// @throw CLI::ValidationError if the output is the input.
inline void requireOtherFile(const std::string& input, const std::string& output) {
  std::error_code ignored;
  if (std::filesystem::equivalent(input, output, ignored))
    throw CLI::ValidationError("--output", "is the input " + input + "; name another file");
}

/// Shows the progress on one line of a terminal. Prints nothing into a log file.
class ProgressLine {
 public:
  explicit ProgressLine(std::string tool) : tool_(std::move(tool)) {}

  void operator()(double share) {
    const int percent = static_cast<int>(100.0 * share);
    if (percent == shown_ || isatty(STDERR_FILENO) == 0) return;
    shown_ = percent;
    std::fprintf(stderr, "\r%s: %3d %%%s", tool_.c_str(), percent, percent >= 100 ? "\n" : "");
  }

 private:
  std::string tool_;
  int shown_ = -1;
};

}  // namespace softbody
