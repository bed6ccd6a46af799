#pragma once

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>

#include <functional>
#include <string>
#include <vector>

#include "softbody_bringup/evaluation/evaluator.h"
#include "softbody_bringup/virtual_camera/bag_writer.h"
#include "softbody_bringup/virtual_camera/camera_setup.h"

namespace softbody::evaluation {

constexpr int kFrames = 20;

/// The sponge in a small image without noise.
inline virtual_camera::CameraSetup smallSetup() {
  virtual_camera::CameraSetup setup;
  setup.body = std::string(CONFIG_DIR) + "/sponge.obj";
  setup.width = 160;
  setup.height = 120;
  setup.noise = virtual_camera::noNoise();
  return setup;
}

/// A clean recording with its truth, made once.
inline const std::string& recording() {
  static const std::string path = [] {
    virtual_camera::VirtualCamera camera = makeCamera(smallSetup());
    const std::string file = testing::TempDir() + "evaluator_recording.bag";
    writeBag(&camera, {file, kFrames, 4.0}, [](int) {});
    return file;
  }();
  return path;
}

/// The truth as if it were a result, after a change. A state whose change returns false is left out.
inline std::string resultFromTruth(const std::string& name,
                                   const std::function<bool(softbody_msgs::MeshState*, int)>& change,
                                   const std::string& truth = recording()) {
  const std::string path = testing::TempDir() + name;
  rosbag::Bag in(truth), out(path, rosbag::bagmode::Write);
  rosbag::View view(in, rosbag::TopicQuery(std::vector<std::string>{"/ground_truth/surface/topology",
                                                                    "/ground_truth/surface/state"}));
  int frame = 0;
  for (const rosbag::MessageInstance& m : view) {
    if (const auto topology = m.instantiate<softbody_msgs::MeshTopology>()) {
      out.write("/softbody/surface/topology", m.getTime(), topology);
    } else if (const auto state = m.instantiate<softbody_msgs::MeshState>()) {
      softbody_msgs::MeshState changed = *state;
      if (change(&changed, frame++)) out.write("/softbody/surface/state", m.getTime(), changed);
    }
  }
  out.close();
  return path;
}

inline bool asItIs(softbody_msgs::MeshState* /*state*/, int /*frame*/) { return true; }

inline bool shift(softbody_msgs::MeshState* state, float dz) {
  for (geometry_msgs::Point32& p : state->vertices) p.z += dz;
  return true;
}

/// What evaluate says where it throws; empty: it does not.
inline std::string failure(const EvaluatorOptions& options) {
  try {
    evaluate(options);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace softbody::evaluation
