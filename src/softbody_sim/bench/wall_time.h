#pragma once

#include <chrono>

namespace softbody::bench {

/// Wall time of some work [s].
template <typename Work>
double secondsOf(const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace softbody::bench
