#include "softbody_sim/surroundings/lasting_fault.h"

namespace softbody {

void LastingFault::begin(const std::string& sentence, LogLines* log) {
  if (sentence_.empty()) log->push_back({true, sentence});
  sentence_ = sentence;
}

void LastingFault::end(const std::string& line, LogLines* log) {
  if (!sentence_.empty()) log->push_back({false, line});
  sentence_.clear();
}

}  // namespace softbody
