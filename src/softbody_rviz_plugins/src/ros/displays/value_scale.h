#pragma once

#include <rviz/properties/bool_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>

#include <memory>
#include <vector>

#include "colors/color.h"
#include "ros/drawing/color_bar.h"

namespace softbody {

/// What a number on the colour bar means.
struct ValueKind {
  const char* title = "";
  double per_unit = 1.0;   ///< shown number per value
  const char* unit = "";   ///< of the shown number
  bool up_to_one = false;  ///< the scale always ends at 1
};

constexpr ValueKind kDeviationValues{"standard deviation", 1e3, "mm", false};
constexpr ValueKind kConfidenceValues{"confidence", 1.0, "", true};
constexpr ValueKind kDistanceValues{"distance from rest", 1e3, "mm", false};
constexpr ValueKind kStrainValues{"strain", 1e2, "%", false};
constexpr ValueKind kQualityValues{"quality (1: regular)", 1.0, "", true};

/// The properties of a colour scale and its bar in the picture.
class ValueScale {
 public:
  /// @param parent gets the properties. @param slot of the receiver, called when one changes.
  ValueScale(rviz::Property* parent, const char* slot, QObject* receiver, bool left);

  /// The bar can be made only when rviz' scene exists.
  void initialize() { bar_ = std::make_unique<ColorBar>(left_); }

  ColorMap map() const;
  /// The end of the scale for these values; also draws the bar.
  double show(const ValueKind& kind, const std::vector<float>& values);
  void hide();

 private:
  rviz::EnumProperty* map_;
  rviz::BoolProperty* automatic_;
  rviz::FloatProperty* maximum_;
  rviz::BoolProperty* shown_;
  bool left_;
  const char* followed_ = nullptr;  // the kind of values that maximum_of_values_ follows
  ScaleMaximum maximum_of_values_;
  std::unique_ptr<ColorBar> bar_;
};

}  // namespace softbody
