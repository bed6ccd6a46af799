#pragma once

#include <malloc.h>

#include <cmath>
#include <ctime>
#include <fstream>
#include <string>

namespace softbody::bench {

/// What a piece of work took.
struct Resources {
  double cpu_s = 0.0;    ///< of all threads
  double peak_mb = 0.0;  ///< more than what the process had before
};

/// A line of /proc/self/status [MB].
inline double memoryOf(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.rfind(key + ":", 0) == 0) return std::stod(line.substr(key.size() + 1)) / 1024.0;
  return std::nan("");
}

template <typename Work>
Resources measure(const Work& work) {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak begins again
  const double before_mb = memoryOf("VmRSS");
  const std::clock_t begin = std::clock();
  work();
  const std::clock_t end = std::clock();
  return {static_cast<double>(end - begin) / CLOCKS_PER_SEC, memoryOf("VmHWM") - before_mb};
}

}  // namespace softbody::bench
