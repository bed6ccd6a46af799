#include "comparison/open_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace softbody::evaluation {

Nanoseconds beginOfOpenLoop(const SurfaceRecord& result, const SurfaceRecord& truth, double share,
                            const std::string& name) {
  const auto is_predicted = [](const auto& entry) {
    return entry.second.observed != 0 && entry.second.observed < entry.first;
  };
  const auto tracked = std::find_if_not(result.states.rbegin(), result.states.rend(), is_predicted);
  const auto predicted = static_cast<std::size_t>(std::distance(result.states.rbegin(), tracked));
  const double asked = share * static_cast<double>(truth.states.size());
  if (predicted == 0 || static_cast<double>(predicted) + 1.0 < asked) {
    throw std::invalid_argument(
        fmt::format("{}: {} states at its end are predicted without images, but {:g} % of the {} frames are "
                    "{:.0f}: make it with replay --open-loop {:g}",
                    name, predicted, 100.0 * share, truth.states.size(), asked, share));
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
