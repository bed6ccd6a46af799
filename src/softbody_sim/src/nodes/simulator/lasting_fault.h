#pragma once

#include <string>

namespace softbody {

/// A fault that lasts: one warning when it begins, one line when it ends, and its sentence in between.
class LastingFault {
 public:
  /// @param sentence the newest description, for diagnostics.
  void begin(const std::string& sentence);
  /// @param line is logged if there was a fault.
  void end(const std::string& line);

  /// Empty: no fault.
  const std::string& sentence() const { return sentence_; }

 private:
  std::string sentence_;
};

}  // namespace softbody
