#include "ros/panel/softbody_panel.h"

#include <fmt/format.h>
#include <ros/service.h>
#include <std_srvs/Trigger.h>

#include <QGroupBox>
#include <QHBoxLayout>
#include <QTimer>
#include <QVBoxLayout>
#include <pluginlib/class_list_macros.hpp>
#include <stdexcept>

#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"
#include "timing/status_words.h"

namespace softbody {
namespace {

constexpr char kNamespace[] = "/softbody";  // of the graph, if rviz' configuration names none
constexpr int kRefresh_ms = 100;
constexpr double kSilent_s = 2.0;

const char* colorOf(TrackingState state) {
  switch (state) {
    case TrackingState::kTracking:
      return "#2f8f4e";
    case TrackingState::kDegraded:
      return "#c98a12";
    case TrackingState::kInitializing:
      return "#4a6fa5";
    default:
      return "#b5382c";
  }
}

void setBanner(QLabel* label, const QString& text, const char* color) {
  label->setText(text);
  label->setStyleSheet(
      QString("background: %1; color: white; font-weight: bold; padding: 6px; border-radius: 4px;")
          .arg(color));
}

QLabel* addLabel(QLayout* layout) {
  auto* label = new QLabel;
  label->setWordWrap(true);
  layout->addWidget(label);
  return label;
}

}  // namespace

SoftbodyPanel::SoftbodyPanel(QWidget* parent) : Panel(parent) {
  auto* rows = new QVBoxLayout(this);
  addState();
  addTimes();
  cut_ = new CutControls(node_, &caller_, this);
  rows->addWidget(cut_);
  answer_ = addLabel(rows);
  stiffness_ = new StiffnessControls(node_, &caller_, this);
  record_ = new RecordButton(node_, answer_);
  rows->insertWidget(rows->indexOf(cut_), record_);
  rows->insertWidget(rows->indexOf(cut_), stiffness_);
  addNamespace();
  rows->addStretch();
}

void SoftbodyPanel::addNamespace() {
  auto* row = new QHBoxLayout;
  static_cast<QVBoxLayout*>(layout())->addLayout(row);
  row->addWidget(new QLabel("Namespace"));
  accepted_namespace_ = kNamespace;
  namespace_ = new QLineEdit(accepted_namespace_);
  namespace_->setObjectName("namespace");
  namespace_->setToolTip("Namespace of the graph; empty: that of rviz");
  row->addWidget(namespace_);
  connect(namespace_, &QLineEdit::editingFinished, [this] {
    setNamespace(namespace_->text());
    Q_EMIT configChanged();
  });
}

void SoftbodyPanel::addState() {
  auto* rows = new QVBoxLayout;
  static_cast<QVBoxLayout*>(layout())->addLayout(rows);
  state_ = addLabel(rows);
  reason_ = addLabel(rows);
  numbers_ = addLabel(rows);
  find_ = new QPushButton("Find again");
  find_->setToolTip("Searches for the body again, as at the start. Cuts stay");
  rows->addWidget(find_);
  connect(find_, &QPushButton::clicked, [this] { findAgain(); });
  setBanner(state_, "No status yet", "#666666");
}

void SoftbodyPanel::addTimes() {
  auto* box = new QGroupBox("Time per frame: mean of a second, and the longest");
  layout()->addWidget(box);
  auto* rows = new QVBoxLayout(box);
  bars_ = new TimeBars(box);
  rows->addWidget(bars_);
  latency_ = addLabel(rows);
}

void SoftbodyPanel::load(const rviz::Config& config) {
  Panel::load(config);
  QString name = kNamespace;
  config.mapGetString("Namespace", &name);
  setNamespace(name);
}

void SoftbodyPanel::save(rviz::Config config) const {
  Panel::save(config);
  config.mapSetValue("Namespace", accepted_namespace_);
}

/// A name that cannot be one changes nothing: the last good one is shown again.
void SoftbodyPanel::setNamespace(const QString& name) try {
  const ros::NodeHandle node(name.toStdString());
  accepted_namespace_ = name;
  namespace_->setText(name);
  if (node.getNamespace() == node_.getNamespace() && !subscribers_.empty()) return;
  node_ = node;
  cut_->setNode(node);
  stiffness_->setNode(node);
  record_->setNode(node);
  topology_.reset();
  times_.clear();
  last_status_ = ros::SteadyTime();
  setBanner(state_, "No status yet", "#666666");
  subscribe();
} catch (const ros::InvalidNameException& error) {
  namespace_->setText(accepted_namespace_);
  answer_->setText(QString("This is no namespace: ") + error.what());
}

void SoftbodyPanel::onInitialize() {
  setNamespace(namespace_->text());
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, [this] { refresh(); });
  timer->start(kRefresh_ms);
}

void SoftbodyPanel::subscribe() {
  subscribers_ = {node_.subscribe(topics::kStatus, 1, &SoftbodyPanel::onStatus, this),
                  node_.subscribe(topics::kTiming, 50, &SoftbodyPanel::onTiming, this),
                  node_.subscribe(topics::kVolumeTopology, 1, &SoftbodyPanel::onTopology, this),
                  node_.subscribe("simulator/parameter_updates", 1, &StiffnessControls::show, stiffness_)};
}

void SoftbodyPanel::onStatus(const softbody_msgs::TrackingStatus& message) {
  TrackingStatus status;
  status.state = static_cast<TrackingState>(message.state);
  status.features_tracked = message.features_tracked;
  status.features_total = message.features_total;
  status.inlier_ratio = message.inlier_ratio;
  status.residual_rms = message.residual_rms;
  setBanner(state_, QString::fromStdString(sentenceOf(status.state)), colorOf(status.state));
  reason_->setText(QString::fromStdString(message.reason));
  reason_->setVisible(!message.reason.empty());
  numbers_->setText(QString::fromStdString(numbersOf(status)));
  last_status_ = ros::SteadyTime::now();
}

void SoftbodyPanel::onTiming(const softbody_msgs::StageTiming& message) {
  std::vector<StageTime> stages;
  for (const softbody_msgs::StageTime& row : message.stages)
    stages.push_back({row.stage, row.milliseconds, row.initialization != 0});
  times_.add(message.node, toNanoseconds(message.header.stamp), stages);
}

void SoftbodyPanel::onTopology(const softbody_msgs::TetTopology::ConstPtr& message) {
  if (topology_ && sameTopology(*topology_, *message)) return;
  try {
    cut_->setBody(fromMessage(*message).rest_vertices);
    topology_ = message;
  } catch (const std::invalid_argument& error) {
    answer_->setText(QString("The topology was refused: ") + error.what());
  }
}

void SoftbodyPanel::findAgain() {
  caller_.start([name = node_.resolveName("feature_tracker/find_again")] {
    std_srvs::Trigger service;
    if (!ros::service::call(name, service))
      return "The service " + name + " does not answer. Is the graph running?";
    return service.response.success ? "The body is searched for again."
                                    : "Not searched: " + service.response.message;
  });
}

void SoftbodyPanel::refresh() {
  const auto period = times_.framePeriod();
  bars_->show(times_.bars(), period);
  const auto latency = times_.latency();
  latency_->setText(QString::fromStdString(fmt::format(
      "Camera to mesh: {}. Frames: {}", latency ? fmt::format("{:.0f} ms", *latency) : "not known",
      period ? fmt::format("{:.1f} Hz", 1e3 / *period) : "none")));
  if (!last_status_.isZero() && (ros::SteadyTime::now() - last_status_).toSec() > kSilent_s)
    setBanner(state_, "Silent: no status for some seconds", "#666666");
  if (const auto answer = caller_.take()) {
    answer_->setText(QString::fromStdString(*answer));
    stiffness_->restore();
  }
  stiffness_->setBusy(caller_.isBusy());
  cut_->setBusy(caller_.isBusy());
  find_->setEnabled(!caller_.isBusy());
}

}  // namespace softbody

PLUGINLIB_EXPORT_CLASS(softbody::SoftbodyPanel, rviz::Panel)
