#pragma once

#include <QWidget>
#include <optional>
#include <vector>

#include "timing/frame_times.h"

namespace softbody {

/// Stage times as bars beside the frame's budget.
class TimeBars : public QWidget {
 public:
  explicit TimeBars(QWidget* parent);

  /// @param budget time between two frames [ms], if known.
  void show(const std::vector<StageBar>& bars, std::optional<double> budget);

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  std::vector<StageBar> bars_;
  std::optional<double> budget_;
};

}  // namespace softbody
