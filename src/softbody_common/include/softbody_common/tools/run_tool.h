#pragma once

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <string>

#include "softbody_common/files/input_file.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_common/tools/package_version.h"

namespace softbody {

/// --version, of every tool.
inline void addVersion(CLI::App* app) {
  app->set_version_flag("--version", packageVersion(), "Print package and version and exit");
}

/// Runs a tool: reads the command line and calls `work`, which returns the exit code. Prints exceptions of
/// the work on stderr. An interrupted tool leaves no incomplete file.
/// @return 0: done; 1: the data could not be processed; 2: wrong usage.
template <typename Work>
int runTool(CLI::App* app, int argc, char** argv, const Work& work) {
  addVersion(app);
  try {
    app->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app->exit(error) == 0 ? 0 : 2;
  }
  removeStagedFilesOnSignal();
  try {
    const int code = work();
    if (!std::cout.flush() || std::fflush(stdout) != 0) throw std::runtime_error("stdout cannot be written");
    return code;
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

/// --allow-outside, of every tool that reads files which other files name.
inline void addAllowOutside(CLI::App* app, FileScope* scope) {
  app->add_flag_callback(
      "--allow-outside", [scope] { *scope = FileScope::kAnywhere; },
      "files that a YAML, a mesh or a data set names may be outside of its folder");
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
