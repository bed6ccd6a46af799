#pragma once

#include <dynamic_reconfigure/Reconfigure.h>
#include <ros/ros.h>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "softbody_common/parameters/parameter_table.h"

namespace softbody {

/// The parameters of a node that may change while it runs, by the protocol of dynamic_reconfigure: the
/// service ~set_parameters, the topics ~parameter_descriptions and ~parameter_updates. rqt_reconfigure and
/// dynparam use them. The service runs in the callback queue of the node, so a change comes between two
/// frames. Each change is also written to the parameter server: a node that starts again has it.
class LiveParameters {
 public:
  using Values = std::function<std::map<std::string, ParameterValue>()>;
  /// Takes over given values. @throw std::invalid_argument if it refuses them; nothing has changed.
  using Change = std::function<void(Parameters& given)>;

  /// @param parameters of the node; only live ones are offered. @param values now, of the live ones.
  LiveParameters(const ros::NodeHandle& private_node, const std::vector<ParameterDescription>& parameters,
                 Values values, Change change);
  /// @param options the present ones; outlives this. @param apply takes over other options, and may refuse
  /// them with std::invalid_argument; `options` changes after it.
  template <typename Options, typename Apply>
  LiveParameters(const ros::NodeHandle& private_node, const ParameterTable<Options>& table, Options* options,
                 Apply apply)
      : LiveParameters(
            private_node, table.describe(*options), [&table, options] { return table.liveValues(*options); },
            [&table, options, apply](Parameters& given) {
              Options next = table.change(given, *options);
              apply(next);
              *options = std::move(next);
            }) {}
  LiveParameters(const LiveParameters&) = delete;
  LiveParameters& operator=(const LiveParameters&) = delete;

  /// The node has changed values by itself: writes and publishes those that are new.
  void publishChanges();

 private:
  bool onSet(dynamic_reconfigure::Reconfigure::Request& request,
             dynamic_reconfigure::Reconfigure::Response& response);

  ros::NodeHandle private_node_;
  Values values_;
  Change change_;
  std::map<std::string, ParameterValue> published_;
  ros::Publisher descriptions_, updates_;
  ros::ServiceServer set_parameters_;
};

}  // namespace softbody
