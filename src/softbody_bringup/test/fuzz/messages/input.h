#pragma once

#include <actionlib_msgs/GoalID.h>
#include <ros/ros.h>

#include <boost/make_shared.hpp>
#include <functional>
#include <future>
#include <string>
#include <utility>

#include "fuzz/messages/driven_node.h"
#include "fuzz/messages/mutation.h"

namespace softbody::fuzz {

/// A way into a node.
class Input {
 public:
  virtual ~Input() = default;
  /// Gives the node something; bad: mutated. The node processes it before this returns.
  /// @return the number of mutated messages that reached it.
  virtual int give(bool bad, Choice* choice) = 0;
};

/// actionlib itself throws if a goal has a stamp near the end of time, and then refuses all goals before it.
template <typename Message>
auto withoutGoalStamp(Message* message) -> decltype(void(message->goal_id)) {
  message->goal_id.stamp = ros::Time();
}
inline void withoutGoalStamp(actionlib_msgs::GoalID* id) { id->stamp = ros::Time(); }
inline void withoutGoalStamp(void* /*no goal*/) {}

/// A topic.
template <typename Message>
class TopicInput : public Input {
 public:
  using Good = std::function<Message()>;

  TopicInput(DrivenNode* node, const std::string& topic, Good good)
      : node_(node), good_(std::move(good)), publisher_(node->handle().advertise<Message>(topic, 10)) {
    node->noteFuzzed(publisher_.getTopic());
  }

  int give(bool bad, Choice* choice) override {
    if (publisher_.getNumSubscribers() == 0) return 0;
    const auto message = boost::make_shared<Message>(good_());
    if (bad) mutate(message.get(), choice);
    withoutGoalStamp(message.get());
    send(message);
    return bad ? 1 : 0;
  }

  void send(const Message& message) { send(boost::make_shared<Message>(message)); }
  void sendGood() { send(good_()); }
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

/// A service.
template <typename Service>
class ServiceInput : public Input {
 public:
  using Request = typename Service::Request;
  using Good = std::function<Request()>;

  ServiceInput(DrivenNode* node, const std::string& name, Good good)
      : node_(node),
        good_(std::move(good)),
        client_(node->privateHandle().serviceClient<Service>(name, true)) {
    node->noteFuzzed(client_.getService());
  }

  int give(bool bad, Choice* choice) override {
    Request request = good_();
    if (bad) mutate(&request, choice);
    send(request);
    return bad ? 1 : 0;
  }

  /// The node processes the call. @return its answer; empty if it refuses with an error.
  typename Service::Response send(const Request& request) {
    if (on_sent_) on_sent_(request);
    if (!client_.isValid())
      client_ = node_->privateHandle().template serviceClient<Service>(client_.getService(), true);
    Service service;
    service.request = request;
    auto call = std::async(std::launch::async, [&] { return client_.call(service); });
    const auto done = [&] { return call.wait_for(std::chrono::seconds(0)) == std::future_status::ready; };
    if (!node_->processUntil(done) || (!call.get() && !client_.isValid()))
      throw std::runtime_error(client_.getService() + " does not answer");
    return service.response;
  }
  typename Service::Response sendGood() { return send(good_()); }

  /// Called with every request.
  void onSent(std::function<void(const Request&)> on_sent) { on_sent_ = std::move(on_sent); }

 private:
  DrivenNode* node_;
  Good good_;
  std::function<void(const Request&)> on_sent_;
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
