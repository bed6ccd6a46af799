#include "ros/panel/record_button.h"

#include <QDateTime>
#include <QDir>

#include "softbody_common/protocol/topics.h"

namespace softbody {
namespace {

constexpr char kStart[] = "Record", kStop[] = "Stop recording";
constexpr int kPatience_ms = 5000;

}  // namespace

RecordButton::RecordButton(const ros::NodeHandle& node, QLabel* answer)
    : QPushButton(kStart), node_(node), answer_(answer) {
  setToolTip("Records the tracked body into a bag, in the folder where rviz was started");
  recorder_.setStandardInputFile(QProcess::nullDevice());
  recorder_.setStandardOutputFile(QProcess::nullDevice());
  connect(this, &QPushButton::clicked, [this] { startOrStop(); });
  connect(&recorder_, QOverload<int, QProcess::ExitStatus>::of(&QProcess::finished), [this] { onEnd(); });
  connect(&recorder_, &QProcess::errorOccurred, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) answer_->setText("Not recorded: there is no program rosrun.");
  });
}

RecordButton::~RecordButton() {
  recorder_.disconnect();
  recorder_.terminate();
  recorder_.waitForFinished(kPatience_ms);
}

void RecordButton::startOrStop() {
  if (recorder_.state() != QProcess::NotRunning) {
    recorder_.terminate();
    return;
  }
  path_ = QDir::current().absoluteFilePath(
      QDateTime::currentDateTime().toString("'softbody_'yyyy-MM-dd-HH-mm-ss-zzz'.bag'"));
  // The command rosbag ends before its child has closed the bag, so the child is started.
  QStringList arguments{"rosbag", "record", "-O", path_};
  for (const char* topic : topics::kTransforms) arguments << topic;
  for (const char* topic : topics::kResult) arguments << QString::fromStdString(node_.resolveName(topic));
  recorder_.start("rosrun", arguments);
  setText(kStop);
  answer_->setText("Recording to " + path_);
}

void RecordButton::onEnd() {
  setText(kStart);
  const QString said = QString::fromLocal8Bit(recorder_.readAllStandardError()).trimmed();
  answer_->setText(QFile::exists(path_) ? "Recorded: " + path_ : "Not recorded to " + path_ + ": " + said);
}

}  // namespace softbody
