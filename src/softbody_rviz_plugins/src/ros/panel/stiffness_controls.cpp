#include "ros/panel/stiffness_controls.h"

#include <dynamic_reconfigure/Reconfigure.h>
#include <fmt/format.h>
#include <ros/service.h>

#include <QGridLayout>
#include <QSignalBlocker>
#include <cmath>

namespace softbody {
namespace {

constexpr int kStepsPerDecade = 20;  // of a slider
constexpr int kFieldWidth = 76;      // [pixels]
constexpr double kPascalPerKilopascal = 1e3;

/// From 10^low to 10^high in the shown unit. A field takes other numbers, too.
QSlider* makeSlider(int low, int high) {
  auto* slider = new QSlider(Qt::Horizontal);
  slider->setRange(low * kStepsPerDecade, high * kStepsPerDecade);
  slider->setTracking(false);  // a value counts when the mouse lets go
  return slider;
}

double numberAt(int step) { return std::pow(10.0, static_cast<double>(step) / kStepsPerDecade); }

int stepOf(double number) {
  return number > 0.0 ? static_cast<int>(std::lround(kStepsPerDecade * std::log10(number))) : 0;
}

QString textOf(double number) { return QString::number(number, 'g', 4); }

std::string setParameter(const std::string& service, const std::string& parameter, double value) {
  dynamic_reconfigure::Reconfigure request;
  request.request.config.doubles.resize(1);
  request.request.config.doubles.front().name = parameter;
  request.request.config.doubles.front().value = value;
  if (!ros::service::exists(service, false))
    return "The service " + service + " does not answer. Is the graph running?";
  if (!ros::service::call(service, request))
    return fmt::format("Not changed: {} = {:g} is refused; the simulator's log says why.", parameter, value);
  return fmt::format("Done: {} = {:g}", parameter, value);
}

}  // namespace

StiffnessControls::StiffnessControls(const ros::NodeHandle& node, ServiceCaller* caller, QWidget* parent)
    : QGroupBox("Stiffness", parent), node_(node), caller_(caller) {
  new QGridLayout(this);
  addRow({"target_stiffness", 1.0, makeSlider(-1, 3), new QLineEdit}, "of targets", "x E x edge",
         "target_stiffness: higher follows the camera closer, lower smooths more");
  addRow({"youngs_modulus_pa", 1.0 / kPascalPerKilopascal, makeSlider(-1, 4), new QLineEdit},
         "of the body (E)", "kPa", "youngs_modulus_pa: Young's modulus of the body");
  setBusy(false);
}

void StiffnessControls::addRow(const StiffnessRow& row, const char* title, const char* unit,
                               const char* tip) {
  auto* grid = static_cast<QGridLayout*>(layout());
  const int line = static_cast<int>(rows_.size());
  row.field->setFixedWidth(kFieldWidth);
  row.slider->setToolTip(tip);
  row.field->setToolTip(tip);
  row.slider->setObjectName(QString::fromStdString(row.parameter));
  row.field->setObjectName(QString::fromStdString(row.parameter));
  grid->addWidget(new QLabel(title), line, 0);
  grid->addWidget(row.slider, line, 1);
  grid->addWidget(row.field, line, 2);
  grid->addWidget(new QLabel(unit), line, 3);
  connect(row.slider, &QSlider::sliderMoved, [row](int step) { row.field->setText(textOf(numberAt(step))); });
  connect(row.slider, &QSlider::valueChanged, [this, row](int step) { set(row, numberAt(step)); });
  connect(row.slider, &QSlider::sliderReleased, [this, row] {
    if (row.slider->sliderPosition() == row.slider->value()) showValue(row);  // dragged back
  });
  connect(row.field, &QLineEdit::returnPressed, [this, row] { enter(row); });
  connect(row.field, &QLineEdit::editingFinished, [this, row] {
    if (row.field->isModified()) showValue(row);  // left without Enter
  });
  rows_.push_back(row);
}

void StiffnessControls::enter(const StiffnessRow& row) {
  bool is_number = false;
  const double shown = row.field->text().toDouble(&is_number);
  row.field->setModified(false);
  if (is_number) {
    set(row, shown);
  } else {
    showValue(row);
  }
}

void StiffnessControls::setNode(const ros::NodeHandle& node) {
  node_ = node;
  values_.clear();
}

void StiffnessControls::show(const dynamic_reconfigure::Config& config) {
  for (const auto& number : config.doubles) values_[number.name] = number.value;
  restore();
}

void StiffnessControls::restore() {
  for (const StiffnessRow& row : rows_) {
    if (!row.slider->isSliderDown() && !row.field->isModified()) showValue(row);
  }
}

void StiffnessControls::showValue(const StiffnessRow& row) {
  const auto value = values_.find(row.parameter);
  if (value == values_.end()) return;
  const double shown = value->second * row.per_unit;
  const QSignalBlocker blocker(row.slider);
  row.slider->setValue(stepOf(shown));
  row.field->setText(textOf(shown));
}

void StiffnessControls::setBusy(bool busy) {
  for (const StiffnessRow& row : rows_) {
    const bool enabled = !busy && values_.count(row.parameter) > 0;
    row.slider->setEnabled(enabled);
    row.field->setEnabled(enabled);
  }
}

void StiffnessControls::set(const StiffnessRow& row, double shown) {
  if (caller_->isBusy()) return restore();
  setBusy(true);
  caller_->start([service = node_.resolveName("simulator/set_parameters"), parameter = row.parameter,
                  value = shown / row.per_unit] { return setParameter(service, parameter, value); });
}

}  // namespace softbody
