/// Selects what is drawn near a place of the hand-made body, as rviz' tool Select does, and prints what its
/// panel Selection shows. Usage: pick_vertex X Y [m]
#include <ros/ros.h>
#include <rviz/display.h>
#include <rviz/properties/property.h>
#include <rviz/properties/property_tree_model.h>
#include <rviz/render_panel.h>
#include <rviz/selection/selection_manager.h>
#include <rviz/view_manager.h>
#include <rviz/visualization_manager.h>

#include <QApplication>
#include <QElapsedTimer>
#include <cmath>
#include <iostream>
#include <string>

namespace {

constexpr int kWidth = 800, kHeight = 600, kHalfBox_px = 8;
constexpr double kPixelsPerMetre = 1000.0;
constexpr int kWait_ms = 4000;  // until the body is drawn

void print(const rviz::Property* property) {
  const std::string value = property->getValue().toString().toStdString();
  std::cout << property->getName().toStdString() << (value.empty() ? "" : ": " + value) << "\n";
  for (int i = 0; i < property->numChildren(); ++i) print(property->childAt(i));
}

void look(rviz::VisualizationManager* manager) {
  manager->setFixedFrame("camera");
  manager->getViewManager()->setCurrentViewControllerType("rviz/TopDownOrtho");
  rviz::Property* view = manager->getViewManager()->getCurrent();
  view->subProp("Scale")->setValue(kPixelsPerMetre);
  view->subProp("X")->setValue(0.0);
  view->subProp("Y")->setValue(0.0);
  rviz::Display* body = manager->createDisplay("softbody_rviz_plugins/SoftBody", "Body", true);
  body->subProp("Topology Topic")->setValue("/test/topology");
  body->subProp("State Topic")->setValue("/test/state");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  QApplication application(argc, argv);
  ros::init(argc, argv, "pick_vertex", ros::init_options::AnonymousName);
  const ros::NodeHandle handle;
  rviz::RenderPanel panel;
  rviz::VisualizationManager manager(&panel);
  panel.initialize(manager.getSceneManager(), &manager);
  manager.initialize();
  manager.startUpdate();
  panel.resize(kWidth, kHeight);
  panel.show();
  look(&manager);
  QElapsedTimer timer;
  timer.start();
  while (timer.elapsed() < kWait_ms) QApplication::processEvents(QEventLoop::AllEvents, 20);
  const int column =
                static_cast<int>(std::lround(panel.width() / 2.0 + kPixelsPerMetre * std::stod(argv[1]))),
            row = static_cast<int>(std::lround(panel.height() / 2.0 - kPixelsPerMetre * std::stod(argv[2])));
  rviz::SelectionManager* selection = manager.getSelectionManager();
  selection->setTextureSize(512);
  selection->select(panel.getViewport(), column - kHalfBox_px, row - kHalfBox_px, column + kHalfBox_px,
                    row + kHalfBox_px, rviz::SelectionManager::Replace);
  const rviz::Property* shown = selection->getPropertyModel()->getRoot();
  for (int i = 0; i < shown->numChildren(); ++i) print(shown->childAt(i));
  std::cout.flush();
  return 0;
}
