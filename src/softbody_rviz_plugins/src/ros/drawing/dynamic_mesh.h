#pragma once

#include <OgreEntity.h>
#include <OgreHardwareVertexBuffer.h>
#include <OgreMaterial.h>
#include <OgreMesh.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

#include <vector>

#include "colors/color.h"
#include "surface/mesh_layout.h"

namespace softbody {

/// A mesh in rviz' scene. Triangles and texture coordinates go to the graphics card once, places and colours
/// whenever they change.
class DynamicMesh {
 public:
  /// Both arguments must outlive the mesh.
  DynamicMesh(Ogre::SceneManager* scene, Ogre::SceneNode* node);
  ~DynamicMesh();
  DynamicMesh(const DynamicMesh&) = delete;
  DynamicMesh& operator=(const DynamicMesh&) = delete;

  /// Replaces the mesh. It is drawn from the next place() on. @param materials one per part of the layout.
  void fill(const MeshLayout& layout, const std::vector<Ogre::MaterialPtr>& materials);
  /// One per drawn vertex of the layout.
  void place(const std::vector<PlacedVertex>& vertices);
  void paint(const std::vector<Color>& colors);
  void clear();
  /// Hidden meshes are not in the scene: rviz makes everything in it visible at times.
  void show(bool shown);

  std::size_t vertexCount() const { return vertex_count_; }
  /// Null before the first fill().
  Ogre::Entity* entity() { return entity_; }

 private:
  void addParts(const MeshLayout& layout);

  Ogre::SceneManager* scene_;
  Ogre::SceneNode* node_;
  Ogre::MeshPtr mesh_;
  Ogre::Entity* entity_ = nullptr;
  Ogre::HardwareVertexBufferSharedPtr places_, colors_;
  std::size_t vertex_count_ = 0;
  bool shown_ = true, placed_ = false;
};

}  // namespace softbody
