#pragma once

#include <nodelet/nodelet.h>

#include <exception>
#include <memory>

namespace softbody {

/// A node class as a nodelet. Its callbacks run one at a time, as in a separate process.
template <typename Node>
class NodeNodelet : public nodelet::Nodelet {
  void onInit() override {
    try {
      node_ = std::make_unique<Node>(getNodeHandle(), getPrivateNodeHandle());
    } catch (const std::exception& error) {
      NODELET_FATAL_STREAM(error.what());
      throw;
    }
  }
  std::unique_ptr<Node> node_;
};

}  // namespace softbody
