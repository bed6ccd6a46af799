#include <dynamic_reconfigure/Config.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <softbody_msgs/CutBody.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/PreviewCut.h>
#include <softbody_msgs/TetTopology.h>
#include <std_srvs/Trigger.h>

#include <QApplication>
#include <QComboBox>
#include <QDir>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QTemporaryDir>
#include <boost/function.hpp>
#include <functional>

#include "ros/panel/softbody_panel.h"

/// Every button of the panel, clicked, with stand-ins for the services of the graph.
namespace softbody {
namespace {

constexpr double kPatience_s = 15.0;

geometry_msgs::Point32 point(float x, float y, float z) {
  geometry_msgs::Point32 result;
  result.x = x, result.y = y, result.z = z;
  return result;
}

/// A tet from (0, 0, 0) to 0.1, 0.2 and 0.4 m on the axes.
softbody_msgs::TetTopology body() {
  softbody_msgs::TetTopology topology;
  topology.rest_vertices = {point(0, 0, 0), point(0.1f, 0, 0), point(0, 0.2f, 0), point(0, 0, 0.4f)};
  topology.tets.resize(1);
  for (unsigned k = 0; k < 4; ++k) topology.tets[0].vertex_indices[k] = k;
  for (const std::array<unsigned, 3>& face :
       std::vector<std::array<unsigned, 3>>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}) {
    shape_msgs::MeshTriangle triangle;
    std::copy(face.begin(), face.end(), triangle.vertex_indices.begin());
    topology.surface_triangles.push_back(triangle);
  }
  topology.vertex_parents = {0, 1, 2, 3};
  topology.tet_bodies = {0};
  return topology;
}

/// @param the namespace of the graph; empty: that of rviz, which has none here.
class Panel : public testing::TestWithParam<const char*> {
 protected:
  Panel() {
    for (const char* name : {"feature_tracker/find_again", "surface/undo", "surface/redo", "surface/reset"})
      addTrigger(name);
    using Cut = softbody_msgs::CutBody;
    servers_.push_back(node_.advertiseService<Cut::Request, Cut::Response>(
        "surface/cut", boost::function<bool(Cut::Request&, Cut::Response&)>([this](auto& in, auto& out) {
          called_.push_back("surface/cut");
          place_ = in.point.y, direction_ = in.normal.y;
          out.success = true;
          out.revision = 7;
          return true;
        })));
    using Preview = softbody_msgs::PreviewCut;
    servers_.push_back(node_.advertiseService<Preview::Request, Preview::Response>(
        "surface/preview",
        boost::function<bool(Preview::Request&, Preview::Response&)>([this](auto&, auto& out) {
          called_.push_back("surface/preview");
          out.success = true;
          out.volumes = {2e-6, 1e-6};
          return true;
        })));
    using Reconfigure = dynamic_reconfigure::Reconfigure;
    servers_.push_back(node_.advertiseService<Reconfigure::Request, Reconfigure::Response>(
        "simulator/set_parameters",
        boost::function<bool(Reconfigure::Request&, Reconfigure::Response&)>([this](auto& in, auto&) {
          const auto& number = in.config.doubles.at(0);
          if (accept_) parameters_[number.name] = number.value;
          publishParameters();
          return accept_;
        })));
    updates_ = node_.advertise<dynamic_reconfigure::Config>("simulator/parameter_updates", 1, true);
    topology_ = node_.advertise<softbody_msgs::TetTopology>("volume/topology", 1, true);
    state_ = node_.advertise<softbody_msgs::MeshState>("surface/state", 1, true);
    panel_.onInitialize();
    if (std::string(GetParam()) == "/softbody") return;  // the panel's own default
    rviz::Config config;
    config.mapSetValue("Namespace", GetParam());
    panel_.load(config);
  }

  void addTrigger(const std::string& name) {
    using Trigger = std_srvs::Trigger;
    servers_.push_back(node_.advertiseService<Trigger::Request, Trigger::Response>(
        name, boost::function<bool(Trigger::Request&, Trigger::Response&)>([this, name](auto&, auto& out) {
          called_.push_back(name);
          out.success = accept_;
          out.message = "there is no reason";
          return true;
        })));
  }

  /// Topics, services and Qt's events are handled here, as in rviz.
  bool waitFor(const std::function<bool()>& condition) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kPatience_s);
    while (!condition() && ros::WallTime::now() < end) {
      ros::spinOnce();
      QApplication::processEvents(QEventLoop::AllEvents, 20);
      ros::WallDuration(0.005).sleep();
    }
    return condition();
  }

  QPushButton* button(const QString& text) {
    for (QPushButton* found : panel_.findChildren<QPushButton*>()) {
      if (found->text() == text) return found;
    }
    return nullptr;
  }

  bool says(const QString& words) {
    for (const QLabel* label : panel_.findChildren<QLabel*>()) {
      if (label->text().contains(words)) return true;
    }
    return false;
  }

  /// Clicks a button as soon as it can be clicked, and waits for the panel's words.
  void expectAnswer(const QString& text, const QString& words) {
    ASSERT_TRUE(waitFor([&] { return button(text) != nullptr && button(text)->isEnabled(); }))
        << text.toStdString();
    button(text)->click();
    EXPECT_TRUE(waitFor([&] { return says(words); })) << text.toStdString();
  }

  void publishParameters() {
    dynamic_reconfigure::Config config;
    for (const auto& [name, value] : parameters_) {
      config.doubles.emplace_back();
      config.doubles.back().name = name;
      config.doubles.back().value = value;
    }
    updates_.publish(config);
  }

  /// The field of a parameter shows a text. Sliders and fields are named after their parameters.
  bool shows(const QString& parameter, const QString& text) {
    return panel_.findChild<QLineEdit*>(parameter)->text() == text;
  }

  void enter(const QString& parameter, const QString& text) {
    auto* field = panel_.findChild<QLineEdit*>(parameter);
    ASSERT_TRUE(waitFor([&] { return field->isEnabled(); }));
    field->setText(text);
    QMetaObject::invokeMethod(field, "returnPressed");
  }

  QString savedNamespace() {
    rviz::Config config;
    panel_.save(config);
    QString saved = "nothing is saved";
    config.mapGetString("Namespace", &saved);
    return saved;
  }

  ros::NodeHandle node_{GetParam()};
  std::map<std::string, double> parameters_{{"target_stiffness", 10.0}, {"youngs_modulus_pa", 2e4}};
  std::vector<std::string> called_;  // services
  double place_ = 0.0, direction_ = 0.0;
  bool accept_ = true;
  std::vector<ros::ServiceServer> servers_;
  ros::Publisher topology_, state_, updates_;
  SoftbodyPanel panel_;
};

TEST_P(Panel, EveryButtonCallsItsServiceAndShowsTheAnswer) {
  EXPECT_FALSE(button("Cut")->isEnabled());  // there is no body yet
  topology_.publish(body());
  expectAnswer("Preview", "Preview: 2 pieces of 2.0, 1.0 cm3");
  panel_.findChild<QComboBox*>()->setCurrentIndex(1);
  auto* slider = panel_.findChild<QSlider*>("position");
  slider->setValue(slider->maximum() / 4);
  expectAnswer("Cut", "Cut; revision 7");
  EXPECT_NEAR(place_, 0.05, 1e-6);  // a quarter of 0.2 m along y
  EXPECT_EQ(direction_, 1.0);
  expectAnswer("Undo", "Done: undo");
  expectAnswer("Redo", "Done: redo");
  expectAnswer("Reset", "Done: reset");
  expectAnswer("Find again", "The body is searched for again.");
  accept_ = false;
  expectAnswer("Find again", "Not searched: there is no reason");
  expectAnswer("Undo", "Not done: there is no reason");
  const std::vector<std::string> expected{"surface/preview",
                                          "surface/cut",
                                          "surface/undo",
                                          "surface/redo",
                                          "surface/reset",
                                          "feature_tracker/find_again",
                                          "feature_tracker/find_again",
                                          "surface/undo"};
  EXPECT_EQ(called_, expected);
}

TEST_P(Panel, StiffnessesAreThoseOfTheGraphAndCanBeChanged) {
  auto* slider = panel_.findChild<QSlider*>("target_stiffness");
  EXPECT_FALSE(slider->isEnabled());  // nothing is known yet
  publishParameters();
  ASSERT_TRUE(waitFor([&] { return shows("target_stiffness", "10") && shows("youngs_modulus_pa", "20"); }));
  const int place = slider->value();
  ASSERT_TRUE(waitFor([&] { return slider->isEnabled(); }));
  slider->setValue(slider->maximum());
  EXPECT_TRUE(waitFor([&] { return parameters_["target_stiffness"] == 1000.0; }));
  EXPECT_TRUE(waitFor([&] { return shows("target_stiffness", "1000"); }));
  enter("youngs_modulus_pa", "7.5");
  EXPECT_TRUE(waitFor([&] { return parameters_["youngs_modulus_pa"] == 7500.0; }));
  EXPECT_EQ(parameters_["target_stiffness"], 1000.0);
  parameters_["target_stiffness"] = 10.0;  // another program changes it
  publishParameters();
  EXPECT_TRUE(waitFor([&] { return slider->value() == place; }));
}

TEST_P(Panel, ARefusedStiffnessGoesBack) {
  publishParameters();
  accept_ = false;
  ASSERT_TRUE(waitFor([&] { return shows("target_stiffness", "10"); }));
  enter("target_stiffness", "-3");
  EXPECT_TRUE(waitFor([&] { return says("Not changed: target_stiffness = -3 is refused"); }));
  EXPECT_TRUE(waitFor([&] { return shows("target_stiffness", "10"); }));
  enter("target_stiffness", "soft");
  EXPECT_TRUE(shows("target_stiffness", "10"));
}

TEST_P(Panel, AChangedStiffnessLeavesWhatTheUserTypesOrDrags) {
  publishParameters();
  ASSERT_TRUE(waitFor([&] { return shows("target_stiffness", "10") && shows("youngs_modulus_pa", "20"); }));
  auto* field = panel_.findChild<QLineEdit*>("target_stiffness");
  field->insert("5");
  parameters_ = {{"target_stiffness", 20.0}, {"youngs_modulus_pa", 3e4}};
  publishParameters();
  ASSERT_TRUE(waitFor([&] { return shows("youngs_modulus_pa", "30"); }));
  EXPECT_TRUE(shows("target_stiffness", "105"));
  Q_EMIT field->editingFinished();  // left without Enter
  EXPECT_TRUE(shows("target_stiffness", "20"));

  auto* slider = panel_.findChild<QSlider*>("youngs_modulus_pa");
  slider->setSliderDown(true);
  slider->setSliderPosition(slider->maximum());
  parameters_ = {{"target_stiffness", 40.0}, {"youngs_modulus_pa", 12345.0}};
  publishParameters();
  ASSERT_TRUE(waitFor([&] { return shows("target_stiffness", "40"); }));
  EXPECT_EQ(slider->sliderPosition(), slider->maximum());
  slider->setSliderPosition(slider->value());  // back to where it was
  slider->setSliderDown(false);
  EXPECT_TRUE(shows("youngs_modulus_pa", "12.35"));
}

TEST_P(Panel, TheRecordButtonWritesABagThatIsWhole) {
  const QTemporaryDir folder;
  QDir::setCurrent(folder.path());
  expectAnswer("Record", "Recording to " + folder.path());
  ASSERT_TRUE(waitFor([&] { return state_.getNumSubscribers() > 0; }));
  state_.publish(softbody_msgs::MeshState());
  waitFor([&] { return !QDir(folder.path()).entryList({"*.active"}).isEmpty(); });
  expectAnswer("Stop recording", "Recorded: " + folder.path());
  EXPECT_EQ(QDir(folder.path()).entryList({"*"}, QDir::Files).filter(".bag").size(), 1);
  EXPECT_TRUE(QDir(folder.path()).entryList({"*.active"}).isEmpty());
  EXPECT_NE(button("Record"), nullptr);
  QDir::setCurrent("/");
}

TEST_P(Panel, TheNamespaceIsSavedAndOneThatIsNoneChangesNothing) {
  auto* line = panel_.findChild<QLineEdit*>("namespace");
  EXPECT_EQ(line->text(), GetParam());
  line->setText("two words");
  Q_EMIT line->editingFinished();
  EXPECT_TRUE(says("This is no namespace"));
  EXPECT_EQ(line->text(), GetParam());
  EXPECT_EQ(savedNamespace(), GetParam());
  topology_.publish(body());
  expectAnswer("Undo", "Done: undo");
  line->setText("/elsewhere");
  Q_EMIT line->editingFinished();
  EXPECT_EQ(savedNamespace(), "/elsewhere");
  expectAnswer("Find again", "/elsewhere/feature_tracker/find_again does not answer");
  EXPECT_FALSE(button("Cut")->isEnabled());  // its body is not known
}

INSTANTIATE_TEST_SUITE_P(Namespaces, Panel, testing::Values("/softbody", "/left", ""),
                         [](const auto& info) { return "Namespace" + std::to_string(info.index); });

}  // namespace
}  // namespace softbody

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "test_panel");
  QApplication application(argc, argv);
  const ros::NodeHandle node;  // keeps ROS alive between the tests
  return RUN_ALL_TESTS();
}
