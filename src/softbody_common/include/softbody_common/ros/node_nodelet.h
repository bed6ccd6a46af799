#pragma once

#include <nodelet/nodelet.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <exception>
#include <memory>
#include <optional>

namespace softbody {

/// A node class as a nodelet. Its callbacks run one at a time, as in a separate process, in a thread of its
/// own: the first begins after the node's constructor, and the last ends before the node's destructor.
template <typename Node>
class NodeNodelet : public nodelet::Nodelet {
 public:
  ~NodeNodelet() override {
    if (spinner_) spinner_->stop();  // waits for the callback that runs
    node_.reset();
  }

 private:
  void onInit() override {
    try {
      ros::NodeHandle handle = getNodeHandle(), private_handle = getPrivateNodeHandle();
      handle.setCallbackQueue(&callbacks_);
      private_handle.setCallbackQueue(&callbacks_);
      node_ = std::make_unique<Node>(handle, private_handle);
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
    spinner_.emplace(1, &callbacks_);
    spinner_->start();
  }

  ros::CallbackQueue callbacks_;
  std::unique_ptr<Node> node_;
  std::optional<ros::AsyncSpinner> spinner_;
};

}  // namespace softbody
