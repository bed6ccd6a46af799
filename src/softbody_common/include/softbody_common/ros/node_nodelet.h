#pragma once

#include <nodelet/nodelet.h>
#include <pthread.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

#include <exception>
#include <memory>
#include <optional>
#include <string>

namespace softbody {

/// Names this thread during its lifetime. A thread inherits its name from the thread that starts it.
class ThreadName {
 public:
  explicit ThreadName(const std::string& name) {
    pthread_getname_np(pthread_self(), before_, sizeof(before_));
    pthread_setname_np(pthread_self(), name.substr(0, sizeof(before_) - 1).c_str());
  }
  ThreadName(const ThreadName&) = delete;
  ThreadName& operator=(const ThreadName&) = delete;
  ~ThreadName() { pthread_setname_np(pthread_self(), before_); }

 private:
  char before_[16] = "";  ///< Linux allows 15 letters
};

/// A node class as a nodelet. Its callbacks run one at a time, as in a separate process, in a thread of its
/// own: the first begins after the node's constructor, and the last ends before the node's destructor. Its
/// threads have the name of the node, as top and a debugger show it.
template <typename Node>
class NodeNodelet : public nodelet::Nodelet {
 public:
  ~NodeNodelet() override {
    if (spinner_) spinner_->stop();  // waits for the callback that runs
    node_.reset();
  }

 private:
  void onInit() override try {
    const std::string& path = getName();
    const ThreadName name(path.substr(path.rfind('/') + 1));
    ros::NodeHandle handle = getNodeHandle(), private_handle = getPrivateNodeHandle();
    handle.setCallbackQueue(&callbacks_);
    private_handle.setCallbackQueue(&callbacks_);
    node_ = std::make_unique<Node>(handle, private_handle);
    spinner_.emplace(1, &callbacks_);
    spinner_->start();
  } catch (const std::exception& error) {
    NODELET_FATAL_STREAM(error.what());
    throw;
  }

  ros::CallbackQueue callbacks_;
  std::unique_ptr<Node> node_;
  std::optional<ros::AsyncSpinner> spinner_;
};

}  // namespace softbody
