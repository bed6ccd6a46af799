#include "ros/panel/time_bars.h"

#include <QPainter>
#include <algorithm>

namespace softbody {
namespace {

constexpr int kRow = 20, kBar = 12, kNames = 170, kNumbers = 64, kTop = 18;  // [pixels]

QColor colorOf(double share) {
  if (share < 0.5) return QColor(64, 160, 90);
  return share < 1.0 ? QColor(214, 160, 40) : QColor(200, 60, 50);
}

}  // namespace

TimeBars::TimeBars(QWidget* parent) : QWidget(parent) { setMinimumHeight(kTop + 5 * kRow); }

void TimeBars::show(const std::vector<StageBar>& bars, std::optional<double> budget) {
  bars_ = bars;
  budget_ = budget;
  setMinimumHeight(kTop + kRow * std::max(5, static_cast<int>(bars.size())) + 4);
  update();
}

void TimeBars::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  if (bars_.empty()) {
    painter.drawText(rect(), Qt::AlignCenter, "No times yet");
    return;
  }
  const double budget = budget_.value_or(1000.0 / 30.0);
  double longest = budget;
  for (const StageBar& bar : bars_) longest = std::max(longest, bar.largest);
  const double pixels_per_ms = (width() - kNames - kNumbers) / (1.05 * longest);
  const auto at = [&](double ms) { return kNames + static_cast<int>(ms * pixels_per_ms); };
  for (std::size_t i = 0; i < bars_.size(); ++i) {
    const StageBar& bar = bars_[i];
    const int y = kTop + static_cast<int>(i) * kRow;
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(
        QRect(0, y, kNames - 8, kRow), Qt::AlignVCenter | Qt::AlignLeft,
        painter.fontMetrics().elidedText(QString::fromStdString(bar.stage), Qt::ElideRight, kNames - 8));
    painter.fillRect(QRect(kNames, y + (kRow - kBar) / 2, at(bar.milliseconds) - kNames, kBar),
                     colorOf(bar.milliseconds / budget));
    painter.fillRect(QRect(at(bar.largest), y + 2, 2, kRow - 4), palette().color(QPalette::Mid));
    painter.drawText(QRect(width() - kNumbers, y, kNumbers, kRow), Qt::AlignVCenter | Qt::AlignRight,
                     QString::number(bar.milliseconds, 'f', bar.milliseconds < 1.0 ? 2 : 1) + " ms");
  }
  painter.setPen(QPen(palette().color(QPalette::WindowText), 1, Qt::DashLine));
  painter.drawLine(at(budget), kTop - 2, at(budget), kTop + kRow * static_cast<int>(bars_.size()));
  painter.drawText(QRect(at(budget) - 150, 0, 150 + kNumbers, kTop - 2), Qt::AlignRight | Qt::AlignVCenter,
                   budget_ ? QString("one frame: %1 ms").arg(budget, 0, 'f', 1) : QString("one frame"));
}

}  // namespace softbody
