#include "comparison/open_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "softbody_common/time/time.h"

namespace softbody::evaluation {
namespace {

constexpr double kLeastShare = 0.9;  // of what is asked for: images may be missing

}  // namespace

Nanoseconds beginOfOpenLoop(const SurfaceRecord& result, const SurfaceRecord& truth, double share,
                            const std::string& name) {
  const auto is_predicted = [](const auto& entry) {
    return entry.second.observed != 0 && entry.second.observed < entry.first;
  };
  const auto tracked = std::find_if_not(result.states.rbegin(), result.states.rend(), is_predicted);
  const auto predicted = std::distance(result.states.rbegin(), tracked);
  const double duration_s = seconds(truth.states.rbegin()->first - truth.states.begin()->first);
  const double predicted_s =
      predicted == 0 ? 0.0 : seconds(truth.states.rbegin()->first - std::prev(tracked)->first);
  const double interval_s = duration_s / static_cast<double>(truth.states.size());
  if (predicted == 0 || predicted_s + interval_s < kLeastShare * share * duration_s) {
    throw std::invalid_argument(
        fmt::format("{}: {} states at its end are predicted without images, {:.2f} s, but {:g} % of {:.2f} s "
                    "are asked for: make it with replay --open-loop {:g}",
                    name, predicted, predicted_s, 100.0 * share, duration_s, share));
  }
  return std::prev(tracked)->first;
}

SurfaceRecord takeFrom(Nanoseconds stamp, SurfaceRecord* record) {
  SurfaceRecord taken{record->frame_id, record->topologies, {}, record->material, {}};
  const auto begin = record->states.lower_bound(stamp);
  taken.states.insert(std::make_move_iterator(begin), std::make_move_iterator(record->states.end()));
  record->states.erase(begin, record->states.end());
  return taken;
}

}  // namespace softbody::evaluation
