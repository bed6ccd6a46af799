#include "ros/drawing/dynamic_mesh.h"

#include <OgreHardwareBufferManager.h>
#include <OgreMeshManager.h>
#include <OgreSubEntity.h>
#include <OgreSubMesh.h>

#include <string>

namespace softbody {
namespace {

static_assert(sizeof(PlacedVertex) == 6 * sizeof(float) && sizeof(Color) == 4,
              "as the vertex declaration says");

constexpr unsigned short kPlaces = 0, kColors = 1, kTexture = 2;  // vertex buffers

std::string freshName() {
  static int count = 0;
  return "softbody mesh " + std::to_string(count++);
}

Ogre::HardwareVertexBufferSharedPtr makeBuffer(std::size_t vertex_size, std::size_t count, bool changes) {
  using Ogre::HardwareBuffer;
  return Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      vertex_size, count,
      changes ? HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE : HardwareBuffer::HBU_STATIC_WRITE_ONLY);
}

template <typename Element>
void write(const std::vector<Element>& elements, const Ogre::HardwareBufferPtr& buffer) {
  buffer->writeData(0, elements.size() * sizeof(Element), elements.data(), true);
}

void declare(Ogre::VertexDeclaration* declaration) {
  declaration->addElement(kPlaces, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
  declaration->addElement(kPlaces, 3 * sizeof(float), Ogre::VET_FLOAT3, Ogre::VES_NORMAL);
  declaration->addElement(kColors, 0, Ogre::VET_COLOUR_ABGR, Ogre::VES_DIFFUSE);
  declaration->addElement(kTexture, 0, Ogre::VET_FLOAT2, Ogre::VES_TEXTURE_COORDINATES);
}

/// Images have their first row on top.
std::vector<Eigen::Vector2f> imageCoordinates(const MeshLayout& layout) {
  std::vector<Eigen::Vector2f> coordinates = layout.texture;
  coordinates.resize(layout.vertices.size(), Eigen::Vector2f::Zero());
  for (Eigen::Vector2f& uv : coordinates) uv.y() = 1.0f - uv.y();
  return coordinates;
}

}  // namespace

DynamicMesh::DynamicMesh(Ogre::SceneManager* scene, Ogre::SceneNode* node) : scene_(scene), node_(node) {}

DynamicMesh::~DynamicMesh() { clear(); }

void DynamicMesh::clear() {
  if (entity_ != nullptr) {
    scene_->destroyEntity(entity_);  // also leaves the node
    entity_ = nullptr;
  }
  if (mesh_) Ogre::MeshManager::getSingleton().remove(mesh_);
  mesh_.reset();
  places_.reset();
  colors_.reset();
  vertex_count_ = 0;
  placed_ = false;
}

void DynamicMesh::fill(const MeshLayout& layout, const std::vector<Ogre::MaterialPtr>& materials) {
  clear();
  vertex_count_ = layout.vertices.size();
  if (vertex_count_ == 0) return;
  mesh_ = Ogre::MeshManager::getSingleton().createManual(
      freshName(), Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  auto* data = mesh_->sharedVertexData = new Ogre::VertexData();  // the mesh deletes it
  data->vertexCount = vertex_count_;
  declare(data->vertexDeclaration);
  places_ = makeBuffer(sizeof(PlacedVertex), vertex_count_, true);
  colors_ = makeBuffer(sizeof(Color), vertex_count_, true);
  const auto texture = makeBuffer(sizeof(Eigen::Vector2f), vertex_count_, false);
  write(imageCoordinates(layout), texture);
  data->vertexBufferBinding->setBinding(kPlaces, places_);
  data->vertexBufferBinding->setBinding(kColors, colors_);
  data->vertexBufferBinding->setBinding(kTexture, texture);
  addParts(layout);
  mesh_->_setBounds(Ogre::AxisAlignedBox::BOX_INFINITE);
  mesh_->load();
  entity_ = scene_->createEntity(mesh_);
  unsigned int drawn = 0;
  for (std::size_t part = 0; part < layout.parts.size(); ++part) {
    if (!layout.parts[part].empty()) entity_->getSubEntity(drawn++)->setMaterial(materials[part]);
  }
}

void DynamicMesh::addParts(const MeshLayout& layout) {
  for (const auto& indices : layout.parts) {
    if (indices.empty()) continue;
    Ogre::SubMesh* part = mesh_->createSubMesh();
    part->useSharedVertices = true;
    part->operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
    part->indexData->indexCount = indices.size();
    part->indexData->indexBuffer = Ogre::HardwareBufferManager::getSingleton().createIndexBuffer(
        Ogre::HardwareIndexBuffer::IT_32BIT, indices.size(), Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
    write(indices, part->indexData->indexBuffer);
  }
}

void DynamicMesh::place(const std::vector<PlacedVertex>& vertices) {
  if (entity_ == nullptr) return;
  write(vertices, places_);
  Ogre::AxisAlignedBox box;
  for (const PlacedVertex& vertex : vertices)
    box.merge(Ogre::Vector3(vertex.position.x(), vertex.position.y(), vertex.position.z()));
  mesh_->_setBounds(box, false);
  placed_ = true;
  show(shown_);
  node_->needUpdate();
}

void DynamicMesh::show(bool shown) {
  shown_ = shown;
  if (entity_ == nullptr || !placed_ || shown == entity_->isAttached()) return;
  if (shown) {
    node_->attachObject(entity_);
  } else {
    node_->detachObject(entity_);
  }
}

void DynamicMesh::paint(const std::vector<Color>& colors) {
  if (entity_ != nullptr) write(colors, colors_);
}

}  // namespace softbody
