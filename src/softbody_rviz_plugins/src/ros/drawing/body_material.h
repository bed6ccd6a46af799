#pragma once

#include <OgreColourValue.h>
#include <OgreMaterial.h>
#include <OgreTexture.h>

namespace softbody {

enum class Style {
  kFaces,
  kFacesAndEdges,
  kEdges  ///< of a closed mesh only those that are not hidden
};

/// How a mesh is drawn. Its vertices' colours multiply the texture's.
struct Look {
  Style style = Style::kFaces;
  Ogre::ColourValue edge_color = Ogre::ColourValue::Black;
  double alpha = 1.0;   ///< below 1: what is behind the nearest faces shines through
  bool lit = true;      ///< false: the colours as they are
  bool closed = false;  ///< the backs of the faces cannot be seen, and are not drawn
  Ogre::TexturePtr texture = {};
};

/// A material with a lamp at the viewer: rviz' own lamp may be behind the body. Both sides of a face are lit.
class BodyMaterial {
 public:
  BodyMaterial();
  ~BodyMaterial();
  BodyMaterial(const BodyMaterial&) = delete;
  BodyMaterial& operator=(const BodyMaterial&) = delete;

  void set(const Look& look);
  const Ogre::MaterialPtr& get() const { return material_; }

 private:
  Ogre::MaterialPtr material_;
};

}  // namespace softbody
