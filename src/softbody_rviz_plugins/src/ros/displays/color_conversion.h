#pragma once

#include <QColor>

#include "colors/color.h"

namespace softbody {

inline Color toColor(const QColor& color) {
  return {static_cast<std::uint8_t>(color.red()), static_cast<std::uint8_t>(color.green()),
          static_cast<std::uint8_t>(color.blue()), 255};
}

}  // namespace softbody
