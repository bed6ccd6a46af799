#pragma once

#include <xmlrpcpp/XmlRpcServer.h>
#include <xmlrpcpp/XmlRpcServerMethod.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <atomic>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace softbody::fuzz {

/// A ROS master for this process alone. Topics inside of a process need no master to connect, so it only says
/// yes. It holds parameters and knows the services of the process.
class LoneMaster {
 public:
  LoneMaster();
  ~LoneMaster();
  LoneMaster(const LoneMaster&) = delete;
  LoneMaster& operator=(const LoneMaster&) = delete;

  std::string uri() const;

  /// The private parameters of a node that is made later. @param values a struct.
  void setParameters(const std::string& node, const XmlRpc::XmlRpcValue& values);

 private:
  using Values = XmlRpc::XmlRpcValue;
  using Reply = std::function<Values(Values& parameters)>;

  struct Method : XmlRpc::XmlRpcServerMethod {
    Method(const std::string& name, XmlRpc::XmlRpcServer* server, Reply the_reply)
        : XmlRpcServerMethod(name, server), reply(std::move(the_reply)) {}
    void execute(Values& parameters, Values& result) override { result = reply(parameters); }
    Reply reply;
  };

  void answer(const std::string& method, Reply reply);
  Values parameter(std::string key) const;

  XmlRpc::XmlRpcServer server_;
  std::vector<std::unique_ptr<Method>> methods_;
  std::map<std::string, Values> parameters_;     ///< by node
  std::map<std::string, std::string> services_;  ///< their addresses
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace softbody::fuzz
