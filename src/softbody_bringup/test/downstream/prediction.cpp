#include "softbody_sim/prediction/prediction.h"

#include <iostream>

#include "softbody_sim/object/object_model.h"

/// What would happen if a ball pressed the sponge by 10 mm, while one end is held?
int main(int, char** argv) {
  const softbody::ObjectModel model = softbody::buildObjectModel(softbody::loadObjectDescription(argv[1]));
  softbody::Simulator present(model.volume, model.material, {});
  softbody::TargetSet start;
  start.reset = true;
  present.step(start, 1);
  softbody::MotionPlan plan;
  plan.pins.push_back({"hand", {}, softbody::PinRegion{"hand", "", {-1, -1, -1}, {-0.05, 1, 1}}});
  plan.obstacles.push_back({"ball", softbody::Obstacle::sphere(0.03)});
  plan.obstacles[0].shape.pose.translation() = Eigen::Vector3d(0.0, 0.0, 0.05);  // it touches the upper side
  plan.obstacles[0].path = {{0.5}, {Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.01))}};
  softbody::PredictionSettings settings;
  settings.times_s = {0.5};
  const softbody::PredictedState end = softbody::predict(present, {plan}, settings)[0][0];
  std::cout << "force on the ball [N]: " << end.reactions.at("ball").force.transpose() << '\n';
  return end.reactions.at("ball").force.z() > 0.0 ? 0 : 1;
}
