#include "fuzz/messages/lone_master.h"

#include <unistd.h>

#include <stdexcept>
#include <utility>

namespace softbody::fuzz {
namespace {

using XmlRpc::XmlRpcValue;

XmlRpcValue response(int code, const XmlRpcValue& value) {
  XmlRpcValue result;
  result[0] = code;
  result[1] = std::string();
  result[2] = value;
  return result;
}

XmlRpcValue emptyList() {
  XmlRpcValue list;
  list.setSize(0);
  return list;
}

}  // namespace

LoneMaster::LoneMaster() {
  constexpr int kDone = 1, kUnknown = -1, kAnyPort = 0;
  for (const char* method : {"registerPublisher", "registerSubscriber"})
    answer(method, [](Values&) { return response(kDone, emptyList()); });
  for (const char* method : {"unregisterPublisher", "unregisterSubscriber", "unregisterService",
                             "subscribeParam", "unsubscribeParam", "deleteParam", "setParam"})
    answer(method, [](Values&) { return response(kDone, 1); });
  answer("getPid", [](Values&) { return response(kDone, static_cast<int>(getpid())); });
  answer("hasParam", [](Values&) { return response(kDone, false); });
  answer("searchParam", [](Values&) { return response(kUnknown, 0); });
  answer("getParam", [this](Values& call) { return parameter(call[1]); });
  answer("registerService", [this](Values& call) {
    services_[call[1]] = std::string(call[2]);
    return response(kDone, 1);
  });
  answer("lookupService", [this](Values& call) {
    const auto found = services_.find(call[1]);
    return found == services_.end() ? response(kUnknown, 0) : response(kDone, found->second);
  });
  if (!server_.bindAndListen(kAnyPort)) throw std::runtime_error("no port is free");
  thread_ = std::thread([this] {
    while (!ends_) server_.work(0.05);
  });
}

LoneMaster::~LoneMaster() {
  ends_ = true;
  thread_.join();
  server_.shutdown();
}

std::string LoneMaster::uri() const {
  return "http://127.0.0.1:" + std::to_string(const_cast<XmlRpc::XmlRpcServer&>(server_).get_port());
}

void LoneMaster::setParameters(const std::string& node, const Values& values) { parameters_[node] = values; }

void LoneMaster::answer(const std::string& method, Reply reply) {
  methods_.push_back(std::make_unique<Method>(method, &server_, std::move(reply)));
}

LoneMaster::Values LoneMaster::parameter(std::string key) const {
  while (key.size() > 1 && key.back() == '/') key.pop_back();
  const auto found = parameters_.find(key);
  return found == parameters_.end() ? response(-1, 0) : response(1, found->second);
}

}  // namespace softbody::fuzz
