#include "ros/panel/cut_controls.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <ros/service.h>
#include <softbody_msgs/CutBody.h>
#include <softbody_msgs/PreviewCut.h>
#include <std_srvs/Trigger.h>

#include <QHBoxLayout>
#include <QVBoxLayout>

namespace softbody {
namespace {

constexpr int kSteps = 200;  // of the slider

std::string noAnswer(const std::string& service) {
  return "The service " + service + " does not answer. Is the graph running?";
}

}  // namespace

CutControls::CutControls(const ros::NodeHandle& node, ServiceCaller* caller, QWidget* parent)
    : QGroupBox("Cut along a plane of the rest shape", parent), node_(node), caller_(caller) {
  auto* rows = new QVBoxLayout(this);
  auto* plane = new QHBoxLayout;
  auto* edits = new QHBoxLayout;
  rows->addLayout(plane);
  rows->addLayout(edits);
  addPlane(plane);
  connect(addButton(edits, "Preview", "Shows the pieces that the cut would make"), &QPushButton::clicked,
          [this] { preview(); });
  connect(addButton(edits, "Cut", "Cuts the model"), &QPushButton::clicked, [this] { cut(); });
  connect(addButton(edits, "Undo", "Takes back the last cut"), &QPushButton::clicked,
          [this] { trigger("undo"); });
  connect(addButton(edits, "Redo", "Makes the last undone cut again"), &QPushButton::clicked,
          [this] { trigger("redo"); });
  connect(addButton(edits, "Reset", "Takes back all cuts"), &QPushButton::clicked,
          [this] { trigger("reset"); });
  setBusy(false);
}

void CutControls::addPlane(QLayout* layout) {
  axis_ = new QComboBox;
  axis_->addItems({"x", "y", "z"});
  axis_->setToolTip("Axis of the body at rest, across which the plane lies");
  slider_ = new QSlider(Qt::Horizontal);
  slider_->setObjectName("position");
  slider_->setRange(0, kSteps);
  slider_->setValue(kSteps / 2);
  place_ = new QLabel;
  place_->setMinimumWidth(76);
  layout->addWidget(axis_);
  layout->addWidget(slider_);
  layout->addWidget(place_);
  connect(axis_, QOverload<int>::of(&QComboBox::currentIndexChanged), [this] { showPosition(); });
  connect(slider_, &QSlider::valueChanged, [this] { showPosition(); });
}

QPushButton* CutControls::addButton(QLayout* layout, const char* text, const char* tip) {
  auto* button = new QPushButton(text);
  button->setToolTip(tip);
  button->setMinimumWidth(40);
  layout->addWidget(button);
  buttons_.push_back(button);
  return button;
}

void CutControls::setNode(const ros::NodeHandle& node) {
  node_ = node;
  has_body_ = false;
}

void CutControls::setBody(const Points& rest_vertices) {
  low_ = rest_vertices.colwise().minCoeff();
  high_ = rest_vertices.colwise().maxCoeff();
  has_body_ = true;
  showPosition();
}

void CutControls::setBusy(bool busy) {
  for (QPushButton* button : buttons_) button->setEnabled(has_body_ && !busy);
}

double CutControls::position() const {
  const int axis = axis_->currentIndex();
  return low_[axis] + (high_[axis] - low_[axis]) * slider_->value() / kSteps;
}

void CutControls::showPosition() {
  place_->setText(QString::fromStdString(fmt::format("{:.1f} mm", 1e3 * position())));
}

template <typename Service>
Service CutControls::planeRequest() const {
  Service service;
  const std::array<double*, 3> point{&service.request.point.x, &service.request.point.y,
                                     &service.request.point.z};
  const std::array<double*, 3> normal{&service.request.normal.x, &service.request.normal.y,
                                      &service.request.normal.z};
  *point[axis_->currentIndex()] = position();
  *normal[axis_->currentIndex()] = 1.0;
  return service;
}

void CutControls::preview() {
  caller_->start([name = node_.resolveName("surface/preview"),
                  service = planeRequest<softbody_msgs::PreviewCut>()]() mutable {
    if (!ros::service::call(name, service)) return noAnswer(name);
    if (!service.response.success) return "No cut there: " + service.response.message;
    std::vector<std::string> volumes;
    for (const double volume : service.response.volumes)
      volumes.push_back(fmt::format("{:.1f}", 1e6 * volume));
    return fmt::format("Preview: {} pieces of {} cm3", volumes.size(), fmt::join(volumes, ", "));
  });
}

void CutControls::cut() {
  caller_->start(
      [name = node_.resolveName("surface/cut"), service = planeRequest<softbody_msgs::CutBody>()]() mutable {
        if (!ros::service::call(name, service)) return noAnswer(name);
        if (!service.response.success) return "Not cut: " + service.response.message;
        return fmt::format("Cut; revision {}", service.response.revision);
      });
}

void CutControls::trigger(const std::string& edit) {
  caller_->start([name = node_.resolveName("surface/" + edit), edit] {
    std_srvs::Trigger service;
    if (!ros::service::call(name, service)) return noAnswer(name);
    return service.response.success ? "Done: " + edit : "Not done: " + service.response.message;
  });
}

}  // namespace softbody
