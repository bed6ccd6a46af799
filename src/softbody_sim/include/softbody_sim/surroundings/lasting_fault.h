#pragma once

#include <string>
#include <vector>

namespace softbody {

struct LogLine {
  bool is_warning = false;
  std::string text;
};

/// Lines for the log of a node or a tool.
using LogLines = std::vector<LogLine>;

/// A fault that lasts: one warning when it begins, one line when it ends, and its sentence in between.
class LastingFault {
 public:
  /// @param sentence the newest description, for diagnostics.
  void begin(const std::string& sentence, LogLines* log) {
    if (sentence_.empty()) log->push_back({true, sentence});
    sentence_ = sentence;
  }
  /// @param line is logged if there was a fault.
  void end(const std::string& line, LogLines* log) {
    if (!sentence_.empty()) log->push_back({false, line});
    sentence_.clear();
  }

  /// Empty: no fault.
  const std::string& sentence() const { return sentence_; }

 private:
  std::string sentence_;
};

}  // namespace softbody
