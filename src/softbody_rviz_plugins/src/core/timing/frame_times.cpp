#include "timing/frame_times.h"

#include <algorithm>
#include <iterator>

#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

constexpr Nanoseconds kShown = 1'000'000'000;
constexpr double kLongest_ms = 1e6;  // a stage that takes a quarter of an hour is a fault of its sender
constexpr char kLatency[] = "camera-to-mesh latency";  // written by the surface
// In the order in which data flows; other nodes come last.
constexpr const char* kNodes[] = {"camera_ingest", "tool_tracker", "feature_tracker", "simulator", "surface"};

auto placeOf(const std::string& node) { return std::find(std::begin(kNodes), std::end(kNodes), node); }

template <typename Sample>
double meanOf(const std::vector<Sample>& samples) {
  double sum = 0.0;
  for (const Sample& sample : samples) sum += sample.milliseconds;
  return sum / static_cast<double>(samples.size());
}

}  // namespace

void FrameTimes::add(const std::string& node, Nanoseconds stamp, const std::vector<StageTime>& stages) {
  if (stamp < newest_ - kShown) clear();  // time jumped back: a bag that is played again
  newest_ = std::max(newest_, stamp);
  stamps_[node].push_back(stamp);
  for (const StageTime& stage : stages) {
    if (!(stage.milliseconds >= 0.0 && stage.milliseconds <= kLongest_ms)) continue;
    if (!stage.initialization) row(node, stage.stage).samples.push_back({stamp, stage.milliseconds});
  }
  forget();
}

std::vector<StageBar> FrameTimes::bars() const {
  std::vector<StageBar> bars;
  for (const Row& row : rows_) {
    if (row.samples.empty() || row.stage == kLatency) continue;
    StageBar bar{row.node, row.stage, meanOf(row.samples), 0.0};
    for (const Sample& sample : row.samples) bar.largest = std::max(bar.largest, sample.milliseconds);
    bars.push_back(bar);
  }
  std::stable_sort(bars.begin(), bars.end(),
                   [](const StageBar& a, const StageBar& b) { return placeOf(a.node) < placeOf(b.node); });
  return bars;
}

std::optional<double> FrameTimes::latency() const {
  for (const Row& row : rows_) {
    if (row.stage == kLatency && !row.samples.empty()) return meanOf(row.samples);
  }
  return std::nullopt;
}

std::optional<double> FrameTimes::framePeriod() const {
  std::vector<Nanoseconds> periods;
  for (const auto& [node, stamps] : stamps_) {
    for (std::size_t i = 1; i < stamps.size(); ++i) {
      if (stamps[i] > stamps[i - 1]) periods.push_back(stamps[i] - stamps[i - 1]);
    }
  }
  if (periods.empty()) return std::nullopt;
  return 1e-6 * static_cast<double>(median(&periods));
}

void FrameTimes::clear() { *this = {}; }

void FrameTimes::forget() {
  const Nanoseconds oldest = newest_ - kShown;
  for (Row& row : rows_) {
    const auto is_old = [&](const Sample& sample) { return sample.stamp < oldest; };
    row.samples.erase(std::remove_if(row.samples.begin(), row.samples.end(), is_old), row.samples.end());
  }
  for (auto& [node, stamps] : stamps_) {
    stamps.erase(std::remove_if(stamps.begin(), stamps.end(), [&](Nanoseconds s) { return s < oldest; }),
                 stamps.end());
  }
}

FrameTimes::Row& FrameTimes::row(const std::string& node, const std::string& stage) {
  for (Row& row : rows_) {
    if (row.node == node && row.stage == stage) return row;
  }
  return rows_.emplace_back(Row{node, stage, {}});
}

}  // namespace softbody
