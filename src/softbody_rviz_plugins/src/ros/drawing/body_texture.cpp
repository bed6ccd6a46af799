#include "ros/drawing/body_texture.h"

#include <OgreImage.h>
#include <OgreResourceGroupManager.h>
#include <OgreTextureManager.h>

#include <QImage>
#include <QImageReader>
#include <stdexcept>
#include <string>

namespace softbody {
namespace {

constexpr int kLargestSide = 4096;  // [pixels]; larger images are made smaller
constexpr int kSquares = 32, kSquareSize = 16;

Ogre::TexturePtr textureOf(const QImage& any_format) {
  static int count = 0;
  QImage image = any_format.convertToFormat(QImage::Format_RGBA8888);
  Ogre::Image pixels;
  pixels.loadDynamicImage(image.bits(), static_cast<Ogre::uint32>(image.width()),
                          static_cast<Ogre::uint32>(image.height()), 1, Ogre::PF_BYTE_RGBA);
  return Ogre::TextureManager::getSingleton().loadImage(
      "softbody texture " + std::to_string(count++), Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME,
      pixels);
}

}  // namespace

void BodyTexture::load(const std::filesystem::path& image) {
  QImageReader reader(QString::fromStdString(image.string()));
  reader.setAutoTransform(false);
  QImage read = reader.read();
  if (read.isNull()) throw std::invalid_argument(image.string() + ": " + reader.errorString().toStdString());
  if (read.width() > kLargestSide || read.height() > kLargestSide)
    read = read.scaled(kLargestSide, kLargestSide, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
  clear();
  texture_ = textureOf(read);
}

void BodyTexture::makeChequers() {
  QImage image(kSquares * kSquareSize, kSquares * kSquareSize, QImage::Format_RGBA8888);
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      const bool dark = (x / kSquareSize + y / kSquareSize) % 2 == 0;
      image.setPixelColor(x, y, dark ? QColor(196, 138, 92) : QColor(238, 206, 168));
    }
  }
  clear();
  texture_ = textureOf(image);
}

void BodyTexture::clear() {
  if (texture_) Ogre::TextureManager::getSingleton().remove(texture_);
  texture_.reset();
}

}  // namespace softbody
