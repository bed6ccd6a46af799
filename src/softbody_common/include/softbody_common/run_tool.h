#pragma once

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <string>

namespace softbody {

/// A tool's main: reads the command line and does the work, which returns the exit code. Says on stderr what
/// the work throws.
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

/// For the callback of a tool's command line. @throw CLI::ValidationError if the output would replace the
/// input.
inline void requireOtherFile(const std::string& input, const std::string& output) {
  std::error_code ignored;
  if (std::filesystem::equivalent(input, output, ignored))
    throw CLI::ValidationError("--output", "is the input " + input + "; name another file");
}

/// Shows on one line of a terminal how much is done; in a log it would be a hundred lines.
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
