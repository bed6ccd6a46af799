#include "identification/mean_wrench.h"

#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

constexpr Nanoseconds kBeside = 50000000;  // [ns] around an image, in which it is at rest enough

/// What has the record's name, as the place of a wrench.
std::optional<MeasuredWrench> placeOf(const std::string& name, const NamedSurroundings& around) {
  MeasuredWrench wrench;
  for (std::size_t k = 0; k < around.pins.size(); ++k)
    if (around.pins[k] == name) wrench.vertices.push_back(around.all.pins[k].vertex);
  std::sort(wrench.vertices.begin(), wrench.vertices.end());
  const auto obstacle = std::find(around.obstacles.begin(), around.obstacles.end(), name);
  if (obstacle != around.obstacles.end())
    wrench.obstacle = static_cast<int>(obstacle - around.obstacles.begin());
  if (wrench.vertices.empty() && wrench.obstacle < 0) return std::nullopt;
  return wrench;
}

}  // namespace

double noiseOf(const std::vector<WrenchSample>& samples) {
  if (samples.size() < 3) return 0.0;
  double squares = 0.0;
  for (std::size_t k = 2; k < samples.size(); ++k)
    squares += (samples[k].value.force - 2.0 * samples[k - 1].value.force + samples[k - 2].value.force)
                   .squaredNorm();
  return std::sqrt(squares / (3.0 * 6.0 * static_cast<double>(samples.size() - 2)));
}

std::optional<MeasuredWrench> meanWrench(const WrenchRecord& record, const NamedSurroundings& around,
                                         Nanoseconds begin, Nanoseconds end) {
  std::optional<MeasuredWrench> mean = placeOf(record.at, around);
  if (!mean) return std::nullopt;
  double count = 0.0;
  for (const WrenchSample& sample : record.samples) {
    if (!record.always && (sample.stamp < begin - kBeside || sample.stamp > end + kBeside)) continue;
    mean->value.force += sample.value.force;
    mean->value.torque += sample.value.torque;
    mean->origin += sample.origin;
    count += 1.0;
  }
  if (count == 0.0) return std::nullopt;
  mean->value.force /= count;
  mean->value.torque /= count;
  mean->origin /= count;
  mean->force_std_n = std::max(record.least_std_n, noiseOf(record.samples) / std::sqrt(count));
  return mean;
}

}  // namespace softbody
