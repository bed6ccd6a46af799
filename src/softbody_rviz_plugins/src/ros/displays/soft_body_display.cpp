#include "ros/displays/soft_body_display.h"

#include <OgreSceneNode.h>
#include <OgreViewport.h>
#include <fmt/format.h>
#include <rviz/display_context.h>
#include <rviz/render_panel.h>
#include <rviz/view_manager.h>
#include <pluginlib/class_list_macros.hpp>

#include <cmath>

#include "ros/displays/color_conversion.h"
#include "softbody_common/images/object_texture.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {
namespace {

const ValueKind& kindOf(SurfaceColoring coloring) {
  switch (coloring) {
    case SurfaceColoring::kStandardDeviation:
      return kDeviationValues;
    case SurfaceColoring::kConfidence:
      return kConfidenceValues;
    case SurfaceColoring::kDistanceFromRest:
      return kDistanceValues;
    default:
      return kStrainValues;
  }
}

/// The name that a topic begins with: that of its node.
std::string parentOf(const ros::NodeHandle& node, const rviz::RosTopicProperty& topic) {
  return ros::names::parentNamespace(node.resolveName(topic.getTopicStd()));
}

}  // namespace

SoftBodyDisplay::SoftBodyDisplay() {
  addTopics("softbody_msgs/MeshTopology", "/softbody/surface/topology", "/softbody/surface/state");
  addColoringProperties();
  addLookProperties();
}

SoftBodyDisplay::~SoftBodyDisplay() {
  unsubscribe();
  clearScene();
}

void SoftBodyDisplay::addColoringProperties() {
  coloring_ = new rviz::EnumProperty("Color By", "One color", "What the colours of the surface show.", this,
                                     SLOT(updateColors()), this);
  const auto add = [&](const char* name, SurfaceColoring option) {
    coloring_->addOption(name, static_cast<int>(option));
  };
  add("Texture", SurfaceColoring::kTexture);
  add("One color", SurfaceColoring::kOneColor);
  add("Piece", SurfaceColoring::kPiece);
  add("Standard deviation", SurfaceColoring::kStandardDeviation);
  add("Confidence", SurfaceColoring::kConfidence);
  add("Distance from rest", SurfaceColoring::kDistanceFromRest);
  add("Strain", SurfaceColoring::kStrain);
  color_ = new rviz::ColorProperty("Color", QColor(225, 150, 90), "Colour of the skin.", this,
                                   SLOT(updateColors()), this);
  cut_color_ = new rviz::ColorProperty("Cut Faces", QColor(190, 45, 45),
                                       "Colour of faces that fill cuts. They show values if the skin does.",
                                       this, SLOT(updateColors()), this);
  image_ = new rviz::StringProperty(
      "Texture Image", "",
      "File with the image of the texture. Empty: the image that the object's OBJ names, or the colours of "
      "the mesh's vertices; the node 'surface' has the object YAML as a parameter. Squares if there is "
      "neither an image nor a colour.",
      this, SLOT(updateColors()), this);
  scale_ = std::make_unique<ValueScale>(this, SLOT(updateColors()), this, true);
}

void SoftBodyDisplay::addLookProperties() {
  style_ = new rviz::EnumProperty("Style", "Faces", "Faces, edges of the triangles, or both.", this,
                                  SLOT(updateLook()), this);
  style_->addOption("Faces", static_cast<int>(Style::kFaces));
  style_->addOption("Faces and edges", static_cast<int>(Style::kFacesAndEdges));
  style_->addOption("Edges", static_cast<int>(Style::kEdges));
  edge_color_ = new rviz::ColorProperty("Edge Color", QColor(40, 40, 44), "Colour of edges.", this,
                                        SLOT(updateLook()), this);
  alpha_ = new rviz::FloatProperty("Alpha", 1.0f, "0: invisible, 1: opaque.", this, SLOT(updateLook()), this);
  alpha_->setMin(0.0f);
  alpha_->setMax(1.0f);
  crease_angle_ = new rviz::FloatProperty(
      "Crease Angle", 50.0f, "Edges whose faces meet at more than this angle at rest stay sharp [degrees].",
      this, SLOT(updateLayout()), this);
  crease_angle_->setMin(0.0f);
  crease_angle_->setMax(180.0f);
  only_on_images_ = new rviz::BoolProperty("Only On Images", false,
                                           "Draws the mesh in Camera displays only, not in the 3-D view.",
                                           this, SLOT(updateVisibility()), this);
}

void SoftBodyDisplay::onInitialize() {
  scale_->initialize();
  skin_material_ = std::make_unique<BodyMaterial>();
  cut_material_ = std::make_unique<BodyMaterial>();
  mesh_ = std::make_unique<DynamicMesh>(scene_manager_, scene_node_);
  VertexSelection::Mesh picked;
  picked.drawn = mesh_.get();
  picked.colors = [this] { return colors_; };
  picked.vertex = [this](int drawn) { return model_->layout().vertices[drawn]; };
  picked.rows = [this](int vertex) { return rowsOf(vertex); };
  picked.place = [this](int vertex) {
    const Eigen::Vector3f p = model_->state()->vertices.row(vertex).cast<float>();
    return scene_node_->convertLocalToWorldPosition({p.x(), p.y(), p.z()});
  };
  selection_.reset(new VertexSelection(context_, picked));
  updateLook();
}

SurfaceColoring SoftBodyDisplay::coloring() const {
  return static_cast<SurfaceColoring>(coloring_->getOptionInt());
}

void SoftBodyDisplay::setTopology(const softbody_msgs::MeshTopology& message) {
  model_.emplace(fromMessage(message), crease_angle_->getFloat() * M_PI / 180.0);
  fillMesh();
  updateLook();
}

void SoftBodyDisplay::fillMesh() {
  mesh_->fill(model_->layout(), {skin_material_->get(), cut_material_->get()});
  if (mesh_->entity() != nullptr) selection_->addTrackedObject(mesh_->entity());
}

void SoftBodyDisplay::setState(const softbody_msgs::MeshState& message) {
  const bool first = !model_->state();
  model_->setState(fromMessage(message));
  if (first || showsValues(coloring())) paint();
  mesh_->place(model_->placed());
  if (first) updateVisibility();
}

void SoftBodyDisplay::paint() {
  if (!model_ || !model_->state()) return;
  SurfacePaint paint{
      coloring(), toColor(color_->getColor()), toColor(cut_color_->getColor()), scale_->map(), 1.0,
      own_colors_};
  const std::vector<float> values = model_->values(paint.coloring);
  if (showsValues(paint.coloring)) {
    paint.maximum = scale_->show(kindOf(paint.coloring), values);
  } else {
    scale_->hide();
  }
  colors_ = model_->painted(paint, values);
  mesh_->paint(colors_);
}

void SoftBodyDisplay::updateColors() {
  if (!skin_material_) return;  // still loading the configuration
  updateLook();
  paint();
  queueRender();
}

void SoftBodyDisplay::updateLook() {
  if (!skin_material_) return;
  loadTexture();
  Look look;
  look.style = static_cast<Style>(style_->getOptionInt());
  look.edge_color = edge_color_->getOgreColor();
  look.alpha = alpha_->getFloat();
  look.closed = model_ && model_->isClosed();
  cut_material_->set(look);
  look.texture = texture_.get();
  skin_material_->set(look);
  queueRender();
}

void SoftBodyDisplay::updateLayout() {
  if (!model_) return;
  const std::optional<MeshState> state = model_->state();
  model_.emplace(model_->topology(), crease_angle_->getFloat() * M_PI / 180.0);
  fillMesh();
  if (!state) return;
  model_->setState(*state);
  paint();
  mesh_->place(model_->placed());
  updateVisibility();
  queueRender();
}

/// rviz gives each view a bit, and every display has all bits. But the 3-D view ignores its own one until it
/// is told.
void SoftBodyDisplay::updateVisibility() {
  if (!skin_material_) return;
  const uint32_t view = context_->getDefaultVisibilityBit();
  if (only_on_images_->getBool()) {
    context_->getViewManager()->getRenderPanel()->getViewport()->setVisibilityMask(view);
    unsetVisibilityBits(view);
  } else {
    setVisibilityBits(view);
  }
  queueRender();
}

void SoftBodyDisplay::loadTexture() {
  texture_.clear();
  own_colors_.clear();
  deleteStatus("Texture");
  if (coloring() != SurfaceColoring::kTexture || !model_) return;
  try {
    accept("Texture", loadOwnLook());
  } catch (const std::exception& error) {
    setStatusStd(rviz::StatusProperty::Warn, "Texture", error.what());
  }
  if (!texture_.get() && own_colors_.empty() && !model_->layout().texture.empty()) texture_.makeChequers();
}

/// The image or else the colours of the vertices. @return what it found.
/// @throw std::invalid_argument if something is missing; the colours that were found are kept.
std::string SoftBodyDisplay::loadOwnLook() {
  const bool has_coordinates = !model_->layout().texture.empty();
  const std::string yaml = objectYaml();
  std::string image = has_coordinates ? image_->getStdString() : "";
  if (has_coordinates && image.empty() && !yaml.empty()) image = textureImageOf(yaml, objectScope());
  if (!image.empty()) {
    texture_.load(image);
    return image;
  }
  if (!yaml.empty())
    own_colors_ = colorsOfVertices(model_->topology(), readObjectColors(yaml, objectScope()));
  if (!has_coordinates && !image_->getStdString().empty())
    throw std::invalid_argument("Texture Image is not used: the mesh has no texture coordinates");
  if (!own_colors_.empty()) return "colours of the vertices in the mesh file";
  if (has_coordinates) return "squares: the object has no image, and its vertices have no colours";
  throw std::invalid_argument("the mesh has no texture coordinates, and its vertices have no colours");
}

/// Parameter of the node that publishes the topology, "/softbody/surface" by default; or empty.
std::string SoftBodyDisplay::objectYaml() const {
  std::string yaml;
  update_nh_.getParam(parentOf(update_nh_, *topology_topic_) + "/object", yaml);
  return yaml;
}

FileScope SoftBodyDisplay::objectScope() const {
  bool anywhere = false;
  update_nh_.getParam(parentOf(update_nh_, *topology_topic_) + "/allow_outside", anywhere);
  return fileScope(anywhere);
}

std::string SoftBodyDisplay::topologyText() const {
  const MeshTopology& topology = model_->topology();
  return fmt::format("revision {}: {} vertices, {} triangles", topology.revision,
                     topology.rest_vertices.rows(), topology.triangles.rows());
}

std::string SoftBodyDisplay::stateText() const {
  return fmt::format("revision {}, {}", model_->state()->revision,
                     model_->state()->standard_deviation.empty() ? "standard deviation not estimated"
                                                                 : "with standard deviations");
}

VertexRows SoftBodyDisplay::rowsOf(int vertex) const {
  const MeshState& state = *model_->state();
  const auto at = [&](SurfaceColoring values) { return model_->values(values)[vertex]; };
  const Eigen::Vector3d place = state.vertices.row(vertex);
  const std::string deviation = state.standard_deviation.empty()
                                    ? "not estimated"
                                    : fmt::format("{:.2f} mm", 1e3 * state.standard_deviation[vertex]);
  return {{"Place [m]", fmt::format("{:.4f}; {:.4f}; {:.4f}", place.x(), place.y(), place.z())},
          {"Standard deviation", deviation},
          {"Confidence", fmt::format("{:.2f}", state.confidence[vertex])},
          {"Piece", fmt::format("{}", model_->vertexPieces()[vertex])},
          {"Distance from rest", fmt::format("{:.2f} mm", 1e3 * at(SurfaceColoring::kDistanceFromRest))},
          {"Strain", fmt::format("{:.1f} %", 1e2 * at(SurfaceColoring::kStrain))}};
}

void SoftBodyDisplay::clearScene() {
  if (mesh_) mesh_->clear();
  model_.reset();
  scale_->hide();
}

}  // namespace softbody

PLUGINLIB_EXPORT_CLASS(softbody::SoftBodyDisplay, rviz::Display)
