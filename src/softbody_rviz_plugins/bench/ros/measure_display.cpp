/// Measures how many frames per second rviz draws with each display, one after the other.
/// scripts/measure_display starts it beside a publisher. Usage: measure_display [TEXT [plain]]
/// Only rows whose names contain TEXT; plain: without anti-aliasing.
#include <OgreFrameListener.h>
#include <OgreRoot.h>
#include <fmt/format.h>
#include <ros/ros.h>
#include <rviz/display.h>
#include <rviz/ogre_helpers/render_system.h>
#include <rviz/properties/property.h>
#include <rviz/properties/property_tree_model.h>
#include <rviz/render_panel.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>

#include <QApplication>
#include <QElapsedTimer>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr int kWidth = 1000, kHeight = 800;
constexpr double kWarmUp_s = 4.0, kMeasured_s = 10.0;
constexpr int kFramesPerSecond = 1000;  // rviz' own limit, out of the way

struct Row {
  const char* name;
  const char* plugin;
  std::vector<std::pair<const char*, const char*>> properties;
};

const std::vector<Row>& rows() {
  static const std::vector<Row> kRows{
      {"nothing", "", {}},
      {"Marker (TRIANGLE_LIST)", "rviz/Marker", {{"Marker Topic", "/softbody/surface/marker"}}},
      {"SoftBody, one colour", "softbody_rviz_plugins/SoftBody", {}},
      {"SoftBody, texture", "softbody_rviz_plugins/SoftBody", {{"Color By", "Texture"}}},
      {"SoftBody, confidence", "softbody_rviz_plugins/SoftBody", {{"Color By", "Confidence"}}},
      {"SoftBody, strain", "softbody_rviz_plugins/SoftBody", {{"Color By", "Strain"}}},
      {"SoftBody, faces and edges", "softbody_rviz_plugins/SoftBody", {{"Style", "Faces and edges"}}}};
  return kRows;
}

class FrameCounter : public Ogre::FrameListener {
 public:
  bool frameEnded(const Ogre::FrameEvent& /*event*/) override {
    ++frames;
    return true;
  }
  int frames = 0;
};

void runFor(double seconds) {
  QElapsedTimer timer;
  timer.start();
  while (timer.elapsed() < 1000.0 * seconds) QApplication::processEvents(QEventLoop::AllEvents, 5);
}

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void look(rviz::VisualizationManager* manager) {
  rviz::Property* options = manager->getDisplayTreeModel()->getRoot()->subProp("Global Options");
  options->subProp("Frame Rate")->setValue(kFramesPerSecond);
  manager->setFixedFrame("camera_color_optical_frame");
  rviz::Property* view = manager->getViewManager()->getCurrent();
  view->subProp("Distance")->setValue(0.35);
  view->subProp("Focal Point")->subProp("Z")->setValue(0.5);
}

void measure(const Row& row, rviz::VisualizationManager* manager, FrameCounter* counter) {
  rviz::Display* display = nullptr;
  if (row.plugin[0] != '\0') {
    display = manager->createDisplay(row.plugin, row.name, true);
    for (const auto& [name, value] : row.properties) display->subProp(name)->setValue(value);
  }
  runFor(kWarmUp_s);
  counter->frames = 0;
  const double cpu = cpuSeconds();
  QElapsedTimer timer;
  timer.start();
  runFor(kMeasured_s);
  const double seconds = 1e-3 * static_cast<double>(timer.elapsed());
  fmt::print("| {} | {:.1f} | {:.0f} |\n", row.name, counter->frames / seconds,
             1e3 * (cpuSeconds() - cpu) / std::max(1, counter->frames));
  std::fflush(stdout);
  delete display;
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  ros::init(argc, argv, "measure_display", ros::init_options::AnonymousName);
  const ros::NodeHandle handle;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() > 1) rviz::RenderSystem::disableAntiAliasing();
  rviz::RenderPanel panel;
  rviz::VisualizationManager manager(&panel);
  panel.initialize(manager.getSceneManager(), &manager);
  manager.initialize();
  manager.startUpdate();
  panel.resize(kWidth, kHeight);
  panel.show();
  look(&manager);
  FrameCounter counter;
  Ogre::Root::getSingleton().addFrameListener(&counter);
  fmt::print("| display | rviz frames per second | CPU time of rviz per frame [ms] |\n| --- | --- | --- |\n");
  const std::string chosen = arguments.empty() ? "" : arguments.front();
  for (const Row& row : rows()) {
    if (std::string(row.name).find(chosen) != std::string::npos) measure(row, &manager, &counter);
  }
  Ogre::Root::getSingleton().removeFrameListener(&counter);
  return 0;
}
