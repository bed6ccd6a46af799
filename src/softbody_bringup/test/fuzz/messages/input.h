#pragma once

#include <ros/ros.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <future>
#include <string>
#include <utility>

#include "fuzz/messages/driven_node.h"
#include "fuzz/messages/message_mutator.h"

namespace softbody::fuzz {

/// A way into a node.
class Input {
 public:
  virtual ~Input() = default;
  /// Gives the node something; bad: mutated. The node processes it before this returns.
  /// @return the number of mutated messages that reached it.
  virtual int give(bool bad, Choice* choice) = 0;
};

/// A topic.
template <typename Message>
class TopicInput : public Input {
 public:
  using Good = std::function<Message()>;

  TopicInput(DrivenNode* node, const std::string& topic, Good good)
      : node_(node), good_(std::move(good)), publisher_(node->handle().advertise<Message>(topic, 10)) {}

  int give(bool bad, Choice* choice) override {
    if (publisher_.getNumSubscribers() == 0) return 0;
    const auto message = boost::make_shared<Message>(good_());
    if (bad) mutate(message.get(), choice);
    send(message);
    return bad ? 1 : 0;
  }

  void send(const boost::shared_ptr<Message>& message) {
    if (on_sent_) on_sent_(*message);
    publisher_.publish(message);
    node_->process();
  }

  /// Called with every message.
  void onSent(std::function<void(const Message&)> on_sent) { on_sent_ = std::move(on_sent); }

 private:
  DrivenNode* node_;
  Good good_;
  std::function<void(const Message&)> on_sent_;
  ros::Publisher publisher_;
};

/// Calls a service while the node processes it. @return false: the node has not answered.
template <typename Service>
bool callService(DrivenNode* node, ros::ServiceClient* client, Service* service) {
  auto call = std::async(std::launch::async, [&] { return client->call(*service); });
  const auto done = [&] { return call.wait_for(std::chrono::seconds(0)) == std::future_status::ready; };
  return node->processUntil(done) && call.get();
}

/// A service.
template <typename Service>
class ServiceInput : public Input {
 public:
  using Good = std::function<typename Service::Request()>;

  ServiceInput(DrivenNode* node, const std::string& name, Good good)
      : node_(node),
        good_(std::move(good)),
        client_(node->privateHandle().serviceClient<Service>(name, true)) {}

  int give(bool bad, Choice* choice) override {
    Service service;
    service.request = good_();
    if (bad) mutate(&service.request, choice);
    if (!client_.isValid())
      client_ = node_->privateHandle().template serviceClient<Service>(client_.getService(), true);
    if (!callService(node_, &client_, &service))
      throw std::runtime_error(client_.getService() + " does not answer");
    return bad ? 1 : 0;
  }

 private:
  DrivenNode* node_;
  Good good_;
  ros::ServiceClient client_;
};

/// The newest message of a topic.
template <typename Message>
class Newest {
 public:
  Newest(DrivenNode* node, const std::string& topic)
      : subscriber_(node->handle().subscribe<Message>(
            topic, 100, [this](const boost::shared_ptr<const Message>& message) { message_ = message; })) {}

  /// nullptr: none has come.
  const Message* get() const { return message_.get(); }
  bool hasStamp(const ros::Time& stamp) const { return message_ && message_->header.stamp == stamp; }

 private:
  boost::shared_ptr<const Message> message_;
  ros::Subscriber subscriber_;
};

}  // namespace softbody::fuzz
