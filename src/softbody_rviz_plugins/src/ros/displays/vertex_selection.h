#pragma once

#include <rviz/selection/selection_handler.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "colors/color.h"
#include "ros/drawing/dynamic_mesh.h"

namespace softbody {

/// Rows of the selection panel: names and values.
using VertexRows = std::vector<std::pair<std::string, std::string>>;

/// Lets rviz' Select tool pick vertices of a mesh: of the triangles under the mouse, the last corners.
class VertexSelection : public rviz::SelectionHandler {
 public:
  struct Mesh {
    DynamicMesh* drawn = nullptr;
    std::function<std::vector<Color>()> colors;  ///< of the drawn vertices, as they are shown
    std::function<int(int)> vertex;              ///< of a drawn vertex: its vertex in the mesh
    std::function<VertexRows(int)> rows;         ///< of a vertex
    std::function<Ogre::Vector3(int)> place;     ///< of a vertex, in the fixed frame
  };

  VertexSelection(rviz::DisplayContext* context, Mesh mesh);

  void createProperties(const rviz::Picked& picked, rviz::Property* parent) override;
  void updateProperties() override;
  void getAABBs(const rviz::Picked& picked, rviz::V_AABB& boxes) override;
  bool needsAdditionalRenderPass(uint32_t pass) override { return pass < 2; }
  void preRenderPass(uint32_t pass) override;
  void postRenderPass(uint32_t pass) override;

 private:
  std::vector<int> verticesOf(const rviz::Picked& picked) const;

  Mesh mesh_;
  std::vector<std::pair<int, rviz::Property*>> shown_;  // vertices and their groups of rows
};

}  // namespace softbody
