#pragma once

#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/string_property.h>
#include <softbody_msgs/MeshTopology.h>

#include <boost/shared_ptr.hpp>
#include <memory>
#include <optional>
#include <vector>

#include "ros/displays/body_display.h"
#include "ros/displays/value_scale.h"
#include "ros/displays/vertex_selection.h"
#include "ros/drawing/body_material.h"
#include "ros/drawing/body_texture.h"
#include "ros/drawing/dynamic_mesh.h"
#include "surface/surface_model.h"

namespace softbody {

/// Draws a visual mesh: MeshTopology and MeshState.
class SoftBodyDisplay : public BodyDisplay<softbody_msgs::MeshTopology> {
  Q_OBJECT

 public:
  SoftBodyDisplay();
  ~SoftBodyDisplay() override;

 protected:
  void onInitialize() override;
  void setTopology(const softbody_msgs::MeshTopology& message) override;
  void setState(const softbody_msgs::MeshState& message) override;
  std::string topologyText() const override;
  std::string stateText() const override;
  void clearScene() override;

 private Q_SLOTS:
  void updateLook();    // materials and texture
  void updateColors();  // of the vertices
  void updateLayout();  // crease angle
  void updateVisibility();

 private:
  void addLookProperties();
  void addColoringProperties();
  SurfaceColoring coloring() const;
  void fillMesh();
  void loadTexture();
  std::string loadOwnLook();
  std::string objectYaml() const;
  FileScope objectScope() const;
  void paint();
  VertexRows rowsOf(int vertex) const;

  rviz::EnumProperty *coloring_, *style_;
  rviz::ColorProperty *color_, *cut_color_, *edge_color_;
  rviz::FloatProperty *alpha_, *crease_angle_;
  rviz::StringProperty* image_;
  rviz::BoolProperty* only_on_images_;
  std::unique_ptr<ValueScale> scale_;

  std::optional<SurfaceModel> model_;
  BodyTexture texture_;
  VertexColors own_colors_;  // of the mesh file, if there is no image
  std::unique_ptr<BodyMaterial> skin_material_, cut_material_;
  std::unique_ptr<DynamicMesh> mesh_;
  boost::shared_ptr<VertexSelection> selection_;
  std::vector<Color> colors_;
};

}  // namespace softbody
