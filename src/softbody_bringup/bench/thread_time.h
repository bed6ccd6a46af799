#pragma once

#include <ctime>

namespace softbody::bench {

/// CPU time of this thread [ms].
inline double threadTime_ms() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// CPU time of this thread for some work [ms].
template <typename Work>
double millisecondsOf(const Work& work) {
  const double start = threadTime_ms();
  work();
  return threadTime_ms() - start;
}

}  // namespace softbody::bench
