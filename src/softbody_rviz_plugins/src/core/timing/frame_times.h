#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_common/time/stage_timer.h"

namespace softbody {

/// Time of one stage, over the last frames.
struct StageBar {
  std::string node, stage;
  double milliseconds = 0.0;  ///< mean of the last second
  double largest = 0.0;       ///< [ms] of the last second
};

/// The stage times that the nodes publish, as bars: the mean of the last second per node and stage.
class FrameTimes {
 public:
  /// Times of a node for one stamp. Stages that happen once (initialisation) do not count.
  void add(const std::string& node, Nanoseconds stamp, const std::vector<StageTime>& stages);

  /// In the order in which data flows through the nodes. Stages that were silent for the last second are left
  /// out. The latency is not a stage.
  std::vector<StageBar> bars() const;

  /// From the camera's stamp to the published mesh [ms], mean of the last second.
  std::optional<double> latency() const;

  /// Time between two frames [ms], the median of the last second; nothing before the second frame.
  std::optional<double> framePeriod() const;

  void clear();

 private:
  struct Sample {
    Nanoseconds stamp;
    double milliseconds;
  };
  struct Row {
    std::string node, stage;
    std::vector<Sample> samples;
  };

  void forget();
  Row& row(const std::string& node, const std::string& stage);

  std::vector<Row> rows_;
  std::map<std::string, std::vector<Nanoseconds>> stamps_;  // per node
  Nanoseconds newest_ = 0;
};

}  // namespace softbody
