#include "ros/displays/value_scale.h"

#include <QString>

namespace softbody {

ValueScale::ValueScale(rviz::Property* parent, const char* slot, QObject* receiver, bool left) : left_(left) {
  map_ = new rviz::EnumProperty("Color Map", "Viridis", "Colours of the values, from 0 to the maximum.",
                                parent, slot, receiver);
  map_->addOption("Viridis", static_cast<int>(ColorMap::kViridis));
  map_->addOption("Cividis", static_cast<int>(ColorMap::kCividis));
  automatic_ = new rviz::BoolProperty("Automatic Maximum", true, "The scale follows the largest values.",
                                      parent, slot, receiver);
  maximum_ = new rviz::FloatProperty(
      "Maximum", 1.0f, "Value at the end of the scale: metres, or relative strain.", parent, slot, receiver);
  maximum_->setMin(1e-9f);
  shown_ =
      new rviz::BoolProperty("Color Bar", true, "Draws the scale into the picture.", parent, slot, receiver);
}

ColorMap ValueScale::map() const { return static_cast<ColorMap>(map_->getOptionInt()); }

double ValueScale::show(const ValueKind& kind, const std::vector<float>& values) {
  if (followed_ != kind.title) maximum_of_values_ = {};
  followed_ = kind.title;
  double maximum = kind.up_to_one ? 1.0 : maximum_of_values_.follow(values);
  if (!automatic_->getBool()) maximum = maximum_->getFloat();
  maximum_->setHidden(automatic_->getBool());
  if (shown_->getBool()) {
    const QString title = QString(kind.title) + (*kind.unit == '\0' ? "" : QString(" [%1]").arg(kind.unit));
    bar_->show(values.empty() ? title + ": not estimated" : title, maximum * kind.per_unit, map());
  } else {
    bar_->hide();
  }
  return maximum;
}

void ValueScale::hide() {
  if (bar_) bar_->hide();
}

}  // namespace softbody
