#pragma once

#include <dynamic_reconfigure/Reconfigure.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "fuzz/messages/input.h"

namespace softbody::fuzz {

/// A node and its inputs.
class Target {
 public:
  virtual ~Target() = default;

  /// Gives the node what a good sender sends. @return what the node does not do; empty: it does its work.
  virtual std::string check() = 0;

  /// Of an input, and how often it is chosen.
  struct Weighted {
    std::unique_ptr<Input> input;
    std::size_t weight;
  };
  std::vector<Weighted> inputs;

 protected:
  /// Adds a topic that is chosen `weight` times as often as one of weight 1.
  template <typename Message>
  TopicInput<Message>* add(DrivenNode* node, const std::string& topic, std::size_t weight,
                           typename TopicInput<Message>::Good good) {
    auto input = std::make_unique<TopicInput<Message>>(node, topic, std::move(good));
    TopicInput<Message>* result = input.get();
    inputs.push_back({std::move(input), weight});
    return result;
  }

  template <typename Service>
  ServiceInput<Service>* addService(DrivenNode* node, const std::string& name,
                                    typename ServiceInput<Service>::Good good) {
    auto input = std::make_unique<ServiceInput<Service>>(node, name, std::move(good));
    ServiceInput<Service>* result = input.get();
    inputs.push_back({std::move(input), 1});
    return result;
  }

  using ParameterInput = ServiceInput<dynamic_reconfigure::Reconfigure>;
  /// The live parameters. A good call gives their first values back.
  ParameterInput* addParameters(DrivenNode* node) {
    dynamic_reconfigure::Reconfigure::Request first;
    {
      const Newest<dynamic_reconfigure::Config> now(node, node->name() + "/parameter_updates");
      node->processUntil([&] { return now.get() != nullptr; });
      first.config = *now.get();
    }
    return addService<dynamic_reconfigure::Reconfigure>(node, "set_parameters", [first] { return first; });
  }
};

/// How a target is made.
struct TargetKind {
  std::string name;
  std::function<std::unique_ptr<Target>()> make;
  std::size_t lifetime;  ///< mutated messages until the node is made again
};

/// All nodes of the graph.
const std::vector<TargetKind>& targetKinds();

std::unique_ptr<Target> makeCameraTarget();
/// Whose images come as JPEG and PNG.
std::unique_ptr<Target> makeCompressedCameraTarget();
std::unique_ptr<Target> makeTrackerTarget();
/// With masks, and in another frame than the camera's.
std::unique_ptr<Target> makePlacedTrackerTarget();
std::unique_ptr<Target> makeToolTarget();
std::unique_ptr<Target> makeMarkerTarget();
std::unique_ptr<Target> makeSimulatorTarget();
/// Without a surface beside it, so that cuts come alone.
std::unique_ptr<Target> makeLoneSimulatorTarget();
/// With a simulator that follows its edits.
std::unique_ptr<Target> makeSurfaceTarget();
/// What the nodes use of tf.
std::unique_ptr<Target> makeTransformTarget();
std::unique_ptr<Target> makeInjectorTarget();
std::unique_ptr<Target> makeScannerTarget();
std::unique_ptr<Target> makeRecorderTarget();
std::unique_ptr<Target> makeModelServerTarget();
/// Bags of a camera.
std::unique_ptr<Target> makeRecordingTarget();
/// rviz with the displays and the panel, on a virtual screen.
std::unique_ptr<Target> makeDisplayTarget();

}  // namespace softbody::fuzz
