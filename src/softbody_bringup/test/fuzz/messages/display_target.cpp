#include <dynamic_reconfigure/Config.h>
#include <rviz/display.h>
#include <rviz/panel.h>
#include <rviz/render_panel.h>
#include <rviz/visualization_manager.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/StageTiming.h>
#include <softbody_msgs/TrackingStatus.h>

#include <QApplication>
#include <cstdio>
#include <pluginlib/class_loader.hpp>

#include "fuzz/messages/block.h"
#include "fuzz/messages/target.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/conversions.h"

namespace softbody::fuzz {
namespace {

constexpr char kFrame[] = "camera_color_optical_frame";

/// Qt with a screen without hardware, which ends with this process.
QApplication& application() {
  static QApplication& application = *[] {
    char number[16] = "";
    FILE* screen =
        popen("exec Xvfb -displayfd 1 -terminate -screen 0 320x240x24 -nolisten tcp 2>/dev/null", "r");
    if (screen == nullptr || std::fgets(number, sizeof(number), screen) == nullptr)
      throw std::runtime_error("Xvfb did not start");
    setenv("DISPLAY", (":" + std::to_string(std::atoi(number))).c_str(), 1);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
    setenv("GALLIUM_DRIVER", "softpipe", 1);
    setenv("QT_X11_NO_MITSHM", "1", 1);
    static int argc = 0;
    return new QApplication(argc, nullptr);
  }();
  return application;
}

/// rviz with the displays and the panel of this project.
class Window {
 public:
  Window() : manager_(&view_), panels_("rviz", "rviz::Panel") {
    view_.initialize(manager_.getSceneManager(), &manager_);
    manager_.initialize();
    manager_.setFixedFrame(kFrame);
    surface_ = manager_.createDisplay("softbody_rviz_plugins/SoftBody", "surface", true);
    tets_ = manager_.createDisplay("softbody_rviz_plugins/Tets", "tets", true);
    tets_->subProp("Targets")->setValue(true);
    surface_->subProp("Color By")->setValue("Strain");
    panel_ = panels_.createUniqueInstance("softbody_rviz_plugins/SoftbodyPanel");
    panel_->initialize(&manager_);
  }

  /// What has come is drawn, as rviz does it for each frame.
  void draw() {
    static_cast<ros::CallbackQueue*>(manager_.getThreadedQueue())->callAvailable();
    for (rviz::Display* display : {surface_, tets_}) display->update(0.01f, 0.01f);
    QApplication::processEvents();
  }

  /// What the displays say of the last topology and state.
  std::string said() const {
    std::string text;
    for (rviz::Display* display : {surface_, tets_}) {
      for (int k = 0; k < display->numChildren(); ++k) {
        rviz::Property* status = display->childAt(k);
        if (!status->getName().startsWith("Status")) continue;
        for (const char* what : {"Topology", "State"})
          text += status->subProp(what)->getValue().toString().toStdString() + "; ";
      }
    }
    return text;
  }

 private:
  QApplication& application_ = application();
  rviz::RenderPanel view_;
  rviz::VisualizationManager manager_;
  pluginlib::ClassLoader<rviz::Panel> panels_;
  pluginlib::UniquePtr<rviz::Panel> panel_;
  rviz::Display *surface_, *tets_;
};

class DisplayTarget : public Target {
 public:
  DisplayTarget()
      : node_("rviz", {}, [this](const auto&, const auto&) {
          static Window& window = *new Window;  // Ogre's materials can be made once in a process
          window_ = &window;
          return std::shared_ptr<Window>(window_, [](Window*) {});
        }) {
    topology_ = drawn<softbody_msgs::MeshTopology>(topics::kSurfaceTopology, 2, [this] {
      softbody_msgs::MeshTopology message = toMessage(block().model.visual);
      message.revision = revision_;
      return message;
    });
    volume_ = drawn<softbody_msgs::TetTopology>(topics::kVolumeTopology, 2, [this] {
      softbody_msgs::TetTopology message = toMessage(block().model.volume);
      message.revision = revision_;
      return message;
    });
    state_ = drawn<softbody_msgs::MeshState>(topics::kSurfaceState, 8,
                                             [this] { return state(block().model.visual.rest_vertices); });
    volume_state_ = drawn<softbody_msgs::MeshState>(
        topics::kVolumeState, 8, [this] { return state(block().model.volume.rest_vertices); });
    drawn<softbody_msgs::Targets>(topics::kTargets, 4, [this] {
      return blockTargets(toMessage(block().model.volume), false, &choice_);
    });
    drawn<softbody_msgs::TrackingStatus>(topics::kStatus, 2, [] { return softbody_msgs::TrackingStatus(); });
    drawn<softbody_msgs::StageTiming>(topics::kTiming, 2, [] { return timing(); });
    drawn<dynamic_reconfigure::Config>("simulator/parameter_updates", 1,
                                       [] { return dynamic_reconfigure::Config(); });
  }

  std::string check() override {
    ++revision_;
    topology_->sendGood();
    volume_->sendGood();
    state_->sendGood();
    volume_state_->sendGood();
    window_->draw();
    const std::string number = "revision " + std::to_string(revision_), said = window_->said();
    int found = 0;
    for (std::size_t at = 0; (at = said.find(number, at)) != std::string::npos; ++at) ++found;
    return found == 4 ? "" : "the displays say: " + said;
  }

 private:
  template <typename Message>
  TopicInput<Message>* drawn(const std::string& topic, std::size_t weight,
                             typename TopicInput<Message>::Good good) {
    TopicInput<Message>* input = add<Message>(&node_, topic, weight, std::move(good));
    input->onSent([this](const Message&) { window_->draw(); });
    return input;
  }

  softbody_msgs::MeshState state(const Points& vertices) const {
    MeshState state;
    state.revision = revision_;
    state.vertices = vertices;
    state.confidence.assign(static_cast<std::size_t>(vertices.rows()), 1.0f);
    softbody_msgs::MeshState message = toMessage(state);
    message.header.frame_id = kFrame;
    message.header.stamp = message.observed = LoneRos::instance().now();
    return message;
  }

  static softbody_msgs::StageTiming timing() {
    softbody_msgs::StageTiming timing;
    timing.header.stamp = LoneRos::instance().now();
    timing.node = "simulator";
    timing.stages.resize(2);
    timing.stages[0].stage = "Step";
    timing.stages[0].milliseconds = 5.0;
    return timing;
  }

  Choice choice_{13};
  std::uint32_t revision_ = 0;
  Window* window_ = nullptr;
  DrivenNode node_;
  TopicInput<softbody_msgs::MeshTopology>* topology_;
  TopicInput<softbody_msgs::TetTopology>* volume_;
  TopicInput<softbody_msgs::MeshState>*state_, *volume_state_;
};

}  // namespace

std::unique_ptr<Target> makeDisplayTarget() { return std::make_unique<DisplayTarget>(); }

}  // namespace softbody::fuzz
