#pragma once

#include <ros/subscriber.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/enum_property.h>
#include <rviz/properties/float_property.h>
#include <softbody_msgs/Targets.h>
#include <softbody_msgs/TetTopology.h>

#include <memory>
#include <optional>

#include "ros/displays/body_display.h"
#include "ros/displays/target_arrows.h"
#include "ros/displays/value_scale.h"
#include "ros/drawing/body_material.h"
#include "ros/drawing/dynamic_mesh.h"
#include "tets/tets_model.h"

namespace softbody {

/// Draws the volume: tets behind a cut-away plane, the low-resolution surface, and the targets.
class TetsDisplay : public BodyDisplay<softbody_msgs::TetTopology> {
  Q_OBJECT

 public:
  TetsDisplay();
  ~TetsDisplay() override;

  void update(float wall_dt, float ros_dt) override;

 protected:
  void onInitialize() override;
  void subscribe() override;
  void unsubscribe() override;
  void setTopology(const softbody_msgs::TetTopology& message) override;
  void setState(const softbody_msgs::MeshState& message) override;
  std::string topologyText() const override;
  std::string stateText() const override;
  void clearScene() override;

 private Q_SLOTS:
  void updateLook();    // materials
  void updateColors();  // of the tets
  void updatePlane();   // which tets are drawn

 private:
  void addTetProperties();
  void addPlaneProperties();
  TetColoring coloring() const;
  void fillTets();
  void drawState();
  void drawArrows();
  void paint();

  rviz::BoolProperty *tets_shown_, *surface_shown_;
  rviz::EnumProperty *coloring_, *style_, *axis_;
  rviz::ColorProperty *color_, *surface_color_;
  rviz::FloatProperty *alpha_, *position_;
  rviz::BoolProperty* flip_;
  std::unique_ptr<ValueScale> scale_;
  TargetArrows arrows_;

  std::optional<TetsModel> model_;
  std::unique_ptr<BodyMaterial> tets_material_, surface_material_;
  std::unique_ptr<DynamicMesh> tets_, surface_;
};

}  // namespace softbody
