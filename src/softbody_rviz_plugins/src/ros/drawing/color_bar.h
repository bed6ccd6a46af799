#pragma once

#include <OgreMaterial.h>
#include <OgreOverlay.h>
#include <OgreTexture.h>

#include <QString>

#include "colors/color.h"

namespace Ogre {
class PanelOverlayElement;
}

namespace softbody {

/// The colours of a scale with their numbers, in a lower corner of the picture.
class ColorBar {
 public:
  /// @param left the corner; two displays can each have one.
  explicit ColorBar(bool left);
  ~ColorBar();
  ColorBar(const ColorBar&) = delete;
  ColorBar& operator=(const ColorBar&) = delete;

  /// @param title what the colours show, with the unit of the numbers.
  /// @param largest the number at the end, > 0.
  void show(const QString& title, double largest, ColorMap map);
  void hide();

 private:
  void draw(const QString& title, double largest, ColorMap map);

  QString shown_;  // title, largest value and map that the texture shows
  Ogre::TexturePtr texture_;
  Ogre::MaterialPtr material_;
  Ogre::PanelOverlayElement* panel_;
  Ogre::Overlay* overlay_;
};

}  // namespace softbody
