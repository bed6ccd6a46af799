#include "ros/displays/target_arrows.h"

#include <boost/function.hpp>

#include "ros/displays/color_conversion.h"
#include "softbody_common/ros/conversions.h"

namespace softbody {

void TargetArrows::addProperties(rviz::Display* display, const char* redraw, const char* resubscribe) {
  shown_ = new rviz::BoolProperty("Targets", true, "Arrows from the body to where each target pulls it.",
                                  display, redraw, display);
  topic_ = new rviz::RosTopicProperty("Targets Topic", "/softbody/targets", "softbody_msgs/Targets",
                                      "What the simulator follows.", shown_, resubscribe, display);
  stretch_ = new rviz::FloatProperty("Length", 1.0f, "Length of the arrows relative to the distance.", shown_,
                                     redraw, display);
  stretch_->setMin(0.0f);
  width_ = new rviz::FloatProperty("Width", 0.0008f, "Width of the arrows [m].", shown_, redraw, display);
  width_->setMin(0.0f);
  const auto add = [&](TargetKind kind, const char* name, const QColor& color) {
    Kind& added = kinds_.at(static_cast<std::size_t>(kind));
    added.kind = kind;
    added.shown = new rviz::BoolProperty(name, true, "Targets of this kind.", shown_, redraw, display);
    added.color = new rviz::ColorProperty("Color", color, "", added.shown, redraw, display);
  };
  add(TargetKind::kFeature, "Features", QColor(80, 220, 100));
  add(TargetKind::kDepth, "Depth", QColor(80, 160, 255));
  add(TargetKind::kVertex, "Vertices", QColor(255, 190, 60));
  add(TargetKind::kManual, "By hand", QColor(240, 90, 200));
}

void TargetArrows::initialize(Ogre::SceneManager* scene, Ogre::SceneNode* node) {
  for (Kind& kind : kinds_) {
    kind.material = std::make_unique<BodyMaterial>();
    Look look;
    look.lit = false;
    kind.material->set(look);
    kind.mesh = std::make_unique<DynamicMesh>(scene, node);
  }
}

void TargetArrows::subscribe(ros::NodeHandle node) {
  subscriber_ =
      node.subscribe<softbody_msgs::Targets>(topic_->getTopicStd(), 1,
                                             boost::function<void(const softbody_msgs::TargetsConstPtr&)>(
                                                 [this](const softbody_msgs::TargetsConstPtr& message) {
                                                   const std::lock_guard lock(mutex_);
                                                   newest_ = message;
                                                 }));
}

void TargetArrows::unsubscribe() {
  subscriber_.shutdown();
  newest_.reset();
  drawn_.reset();
}

bool TargetArrows::hasNews() {
  const std::lock_guard lock(mutex_);
  return newest_ != drawn_;
}

void TargetArrows::draw(const TetsModel& tets) {
  softbody_msgs::TargetsConstPtr newest;
  {
    const std::lock_guard lock(mutex_);
    newest = drawn_ = newest_;
  }
  if (!shown_->getBool() || !newest || newest->revision != tets.topology().revision) return clear();
  const TargetSet targets = fromMessage(*newest);
  for (Kind& kind : kinds_) {
    if (!kind.shown->getBool()) {
      kind.mesh->clear();
      kind.capacity = 0;
    } else {
      draw(tets.arrows(targets, kind.kind, stretch_->getFloat()), &kind);
    }
  }
}

void TargetArrows::draw(const std::vector<Arrow>& arrows, Kind* kind) {
  const int count = static_cast<int>(arrows.size());
  if (count > kind->capacity) {
    kind->capacity = 2 * count;  // room for later frames
    kind->mesh->fill(layoutOfArrows(kind->capacity), {kind->material->get()});
  }
  if (kind->capacity == 0) return;
  kind->mesh->paint(std::vector<Color>(kind->mesh->vertexCount(), toColor(kind->color->getColor())));
  kind->mesh->place(placeArrows(arrows, kind->capacity, width_->getFloat()));
}

void TargetArrows::clear() {
  for (Kind& kind : kinds_) {
    if (kind.mesh) kind.mesh->clear();
    kind.capacity = 0;
  }
}

}  // namespace softbody
