#include "ros/displays/tets_display.h"

#include <fmt/format.h>
#include <rviz/display_context.h>
#include <pluginlib/class_list_macros.hpp>

#include "ros/displays/color_conversion.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

const ValueKind& kindOf(TetColoring coloring) {
  switch (coloring) {
    case TetColoring::kQuality:
      return kQualityValues;
    case TetColoring::kStandardDeviation:
      return kDeviationValues;
    case TetColoring::kConfidence:
      return kConfidenceValues;
    default:
      return kStrainValues;
  }
}

}  // namespace

TetsDisplay::TetsDisplay() {
  addTopics("softbody_msgs/TetTopology", "/softbody/volume/topology", "/softbody/volume/state");
  addTetProperties();
  addPlaneProperties();
  surface_shown_ =
      new rviz::BoolProperty("Low-resolution Surface", false, "The boundary of the tets, as edges.", this,
                             SLOT(updateColors()), this);
  surface_color_ =
      new rviz::ColorProperty("Color", QColor(230, 230, 230), "", surface_shown_, SLOT(updateLook()), this);
  arrows_.addProperties(this, SLOT(updateColors()), SLOT(resubscribe()));
}

TetsDisplay::~TetsDisplay() {
  unsubscribe();
  clearScene();
}

void TetsDisplay::addTetProperties() {
  tets_shown_ = new rviz::BoolProperty("Tets", true, "Draws the tets.", this, SLOT(updateColors()), this);
  coloring_ = new rviz::EnumProperty("Color By", "Strain", "What the colours of the tets show.", tets_shown_,
                                     SLOT(updateColors()), this);
  const auto add = [&](const char* name, TetColoring option) {
    coloring_->addOption(name, static_cast<int>(option));
  };
  add("One color", TetColoring::kOneColor);
  add("Piece", TetColoring::kPiece);
  add("Quality", TetColoring::kQuality);
  add("Strain", TetColoring::kStrain);
  add("Standard deviation", TetColoring::kStandardDeviation);
  add("Confidence", TetColoring::kConfidence);
  color_ =
      new rviz::ColorProperty("Color", QColor(110, 150, 200), "", tets_shown_, SLOT(updateColors()), this);
  scale_ = std::make_unique<ValueScale>(tets_shown_, SLOT(updateColors()), this, false);
  style_ = new rviz::EnumProperty("Style", "Faces and edges", "Faces, edges, or both.", tets_shown_,
                                  SLOT(updateLook()), this);
  style_->addOption("Faces", static_cast<int>(Style::kFaces));
  style_->addOption("Faces and edges", static_cast<int>(Style::kFacesAndEdges));
  style_->addOption("Edges", static_cast<int>(Style::kEdges));
  alpha_ = new rviz::FloatProperty("Alpha", 1.0f, "0: invisible, 1: opaque.", tets_shown_, SLOT(updateLook()),
                                   this);
  alpha_->setMin(0.0f);
  alpha_->setMax(1.0f);
}

void TetsDisplay::addPlaneProperties() {
  axis_ =
      new rviz::EnumProperty("Cut Away Along", "X", "Axis of the body at rest, across which the plane lies.",
                             tets_shown_, SLOT(updatePlane()), this);
  axis_->addOption("X", 0);
  axis_->addOption("Y", 1);
  axis_->addOption("Z", 2);
  position_ = new rviz::FloatProperty("Plane Position", 1.0f,
                                      "0 to 1, across the body. Tets beyond the plane are not drawn.",
                                      tets_shown_, SLOT(updatePlane()), this);
  position_->setMin(0.0f);
  position_->setMax(1.0f);
  flip_ = new rviz::BoolProperty("Flip Plane", false, "Hides the tets on the other side.", tets_shown_,
                                 SLOT(updatePlane()), this);
}

void TetsDisplay::onInitialize() {
  scale_->initialize();
  arrows_.initialize(scene_manager_, scene_node_);
  tets_material_ = std::make_unique<BodyMaterial>();
  surface_material_ = std::make_unique<BodyMaterial>();
  tets_ = std::make_unique<DynamicMesh>(scene_manager_, scene_node_);
  surface_ = std::make_unique<DynamicMesh>(scene_manager_, scene_node_);
  updateLook();
}

void TetsDisplay::subscribe() {
  BodyDisplay::subscribe();
  arrows_.subscribe(threaded_nh_);
}

void TetsDisplay::unsubscribe() {
  arrows_.unsubscribe();
  BodyDisplay::unsubscribe();
}

void TetsDisplay::update(float wall_dt, float ros_dt) {
  BodyDisplay::update(wall_dt, ros_dt);
  if (!model_ || !model_->state() || !arrows_.hasNews()) return;
  drawArrows();  // targets that came after the state
  queueRender();
}

TetColoring TetsDisplay::coloring() const { return static_cast<TetColoring>(coloring_->getOptionInt()); }

void TetsDisplay::setTopology(const softbody_msgs::TetTopology& message) {
  model_.emplace(fromMessage(message));
  surface_->fill(model_->surfaceLayout(), {surface_material_->get()});
  fillTets();
}

void TetsDisplay::fillTets() {
  model_->cutAway({axis_->getOptionInt(), position_->getFloat(), flip_->getBool()});
  tets_->fill(model_->layout(), {tets_material_->get()});
}

void TetsDisplay::setState(const softbody_msgs::MeshState& message) {
  model_->setState(fromMessage(message));
  drawState();
}

void TetsDisplay::drawState() {
  paint();
  tets_->place(model_->placed());
  surface_->place(model_->placedSurface());
  tets_->show(tets_shown_->getBool());
  surface_->show(surface_shown_->getBool());
  drawArrows();
}

void TetsDisplay::drawArrows() {
  try {
    arrows_.draw(*model_);
    deleteStatus("Targets");
  } catch (const std::exception& error) {
    refuse("Targets", error);
  }
}

void TetsDisplay::paint() {
  double maximum = 1.0;
  const std::vector<float> values = model_->values(coloring());
  if (tets_shown_->getBool() && showsValues(coloring())) {
    maximum = scale_->show(kindOf(coloring()), values);
  } else {
    scale_->hide();
  }
  tets_->paint(model_->painted(coloring(), toColor(color_->getColor()), scale_->map(), values, maximum));
}

void TetsDisplay::updateColors() {
  if (!model_ || !model_->state()) return;
  drawState();
  queueRender();
}

void TetsDisplay::updatePlane() {
  if (!model_) return;
  fillTets();
  updateColors();
}

void TetsDisplay::updateLook() {
  if (!tets_material_) return;  // still loading the configuration
  Look look;
  look.style = static_cast<Style>(style_->getOptionInt());
  look.edge_color = Ogre::ColourValue(0.1f, 0.1f, 0.12f);
  look.alpha = alpha_->getFloat();
  tets_material_->set(look);
  look = {};
  look.style = Style::kEdges;
  look.edge_color = surface_color_->getOgreColor();
  surface_material_->set(look);
  queueRender();
}

std::string TetsDisplay::topologyText() const {
  const TetTopology& topology = model_->topology();
  return fmt::format("revision {}: {} vertices, {} tets", topology.revision, topology.rest_vertices.rows(),
                     topology.tets.rows());
}

std::string TetsDisplay::stateText() const { return fmt::format("revision {}", model_->state()->revision); }

void TetsDisplay::clearScene() {
  arrows_.clear();
  if (tets_) tets_->clear();
  if (surface_) surface_->clear();
  model_.reset();
  scale_->hide();
}

}  // namespace softbody

PLUGINLIB_EXPORT_CLASS(softbody::TetsDisplay, rviz::Display)
