#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>

/// On one thread, as the graph's nodes run.
int main(int argc, char** argv) {
  cv::setNumThreads(1);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
