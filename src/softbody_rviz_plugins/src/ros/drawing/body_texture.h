#pragma once

#include <OgreTexture.h>

#include <filesystem>

namespace softbody {

/// Images on meshes.
class BodyTexture {
 public:
  ~BodyTexture() { clear(); }

  /// @throw std::invalid_argument if the image cannot be read.
  void load(const std::filesystem::path& image);
  /// Grey and white squares: they show how the surface deforms if its image is not known.
  void makeChequers();
  void clear();

  const Ogre::TexturePtr& get() const { return texture_; }

 private:
  Ogre::TexturePtr texture_;
};

}  // namespace softbody
