#include "ros/drawing/color_bar.h"

#include <OgreHardwarePixelBuffer.h>
#include <OgreMaterialManager.h>
#include <OgreOverlayManager.h>
#include <OgrePanelOverlayElement.h>
#include <OgrePass.h>
#include <OgreResourceGroupManager.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>
#include <OgreTextureUnitState.h>

#include <QImage>
#include <QPainter>
#include <algorithm>
#include <cmath>
#include <string>

namespace softbody {
namespace {

constexpr int kWidth = 300, kHeight = 68, kMargin = 14, kEdge = 3;  // [pixels]
constexpr int kBarTop = 28, kBarHeight = 14, kTickHeight = 4, kLabelMiddle = 56;

void setFont(QPainter* painter, int pixels) {
  QFont font = painter->font();
  font.setPixelSize(pixels);
  painter->setFont(font);
}

/// A short line below the bar with its number.
void drawTick(QPainter* painter, double share, double number) {
  const int x = kMargin + static_cast<int>(std::lround(share * (kWidth - 2 * kMargin - 1)));
  painter->drawLine(x, kBarTop + kBarHeight, x, kBarTop + kBarHeight + kTickHeight);
  QRect label = painter->fontMetrics().boundingRect(QString::number(number, 'g', 3));
  label.moveCenter(
      {std::clamp(x, kEdge + label.width() / 2, kWidth - kEdge - label.width() / 2), kLabelMiddle});
  painter->drawText(label.adjusted(-1, 0, 1, 0), Qt::AlignCenter, QString::number(number, 'g', 3));
}

QImage pictureOf(const QString& title, double largest, ColorMap map) {
  QImage image(kWidth, kHeight, QImage::Format_RGBA8888);
  image.fill(QColor(20, 22, 26, 170));
  for (int x = kMargin; x < kWidth - kMargin; ++x) {
    const Color color = colorOf(map, static_cast<double>(x - kMargin) / (kWidth - 2 * kMargin - 1));
    for (int y = kBarTop; y < kBarTop + kBarHeight; ++y)
      image.setPixelColor(x, y, QColor(color.red, color.green, color.blue));
  }
  QPainter painter(&image);
  painter.setRenderHint(QPainter::TextAntialiasing);
  painter.setPen(Qt::white);
  setFont(&painter, 14);
  painter.drawText(QRect(kMargin, 5, kWidth - 2 * kMargin, kBarTop), Qt::AlignLeft | Qt::AlignTop, title);
  setFont(&painter, 12);
  for (const double tick : ticksOf(largest)) drawTick(&painter, tick / largest, tick);
  return image;
}

}  // namespace

ColorBar::ColorBar(bool left) {
  static int count = 0;
  const std::string name = "softbody color bar " + std::to_string(count++);
  const std::string& group = Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME;
  texture_ = Ogre::TextureManager::getSingleton().createManual(name, group, Ogre::TEX_TYPE_2D, kWidth,
                                                               kHeight, 0, Ogre::PF_BYTE_RGBA,
                                                               Ogre::TU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
  material_ = Ogre::MaterialManager::getSingleton().create(name, group);
  Ogre::Pass* pass = material_->getTechnique(0)->getPass(0);
  pass->setLightingEnabled(false);
  pass->setDepthCheckEnabled(false);
  pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  pass->createTextureUnitState()->setTexture(texture_);
  auto& overlays = Ogre::OverlayManager::getSingleton();
  panel_ = static_cast<Ogre::PanelOverlayElement*>(overlays.createOverlayElement("Panel", name));
  panel_->setMetricsMode(Ogre::GMM_PIXELS);
  panel_->setHorizontalAlignment(left ? Ogre::GHA_LEFT : Ogre::GHA_RIGHT);
  panel_->setVerticalAlignment(Ogre::GVA_BOTTOM);
  panel_->setPosition(left ? kMargin : -kMargin - kWidth, -kMargin - kHeight);
  panel_->setDimensions(kWidth, kHeight);
  panel_->setMaterial(material_);
  overlay_ = overlays.create(name);
  overlay_->add2D(panel_);
}

ColorBar::~ColorBar() {
  auto& overlays = Ogre::OverlayManager::getSingleton();
  overlay_->remove2D(panel_);
  overlays.destroyOverlayElement(panel_);
  overlays.destroy(overlay_);
  Ogre::MaterialManager::getSingleton().remove(material_);
  Ogre::TextureManager::getSingleton().remove(texture_);
}

void ColorBar::show(const QString& title, double largest, ColorMap map) {
  const QString wanted =
      title + '\n' + QString::number(largest) + '\n' + QString::number(static_cast<int>(map));
  if (wanted != shown_) draw(title, largest, map);
  shown_ = wanted;
  overlay_->show();
}

void ColorBar::hide() { overlay_->hide(); }

void ColorBar::draw(const QString& title, double largest, ColorMap map) {
  QImage image = pictureOf(title, largest, map);
  const Ogre::PixelBox pixels(kWidth, kHeight, 1, Ogre::PF_BYTE_RGBA, image.bits());
  texture_->getBuffer()->blitFromMemory(pixels);
}

}  // namespace softbody
