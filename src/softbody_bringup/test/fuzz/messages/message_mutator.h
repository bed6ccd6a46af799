#pragma once

#include <ros/serialization.h>

#include <boost/array.hpp>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "fuzz/messages/mutation.h"

namespace softbody::fuzz {

/// Walks a message of any type as its serializer does, and changes it at one place. A place is a number, a
/// text, a time or the length of a list. Of a list, only some elements are visited.
class MessageWalk {
 public:
  /// @param path selects the elements of lists. @param chosen place to change; kNowhere: only counts.
  MessageWalk(std::uint64_t path, std::size_t chosen, Choice* choice)
      : path_(path), chosen_(chosen), choice_(choice) {}

  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);

  /// Called by the serializers, for every field.
  template <typename T>
  void next(T& field) {
    if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string> || std::is_same_v<T, ros::Time> ||
                  std::is_same_v<T, ros::Duration>) {
      if (places_++ == chosen_) change(&field, choice_);
    } else {
      walk(field);
    }
  }

  std::size_t places() const { return places_; }

 private:
  template <typename Element>
  void walk(std::vector<Element>& list) {
    if (places_++ == chosen_) return changeList(&list, choice_);
    if (list.empty()) return;
    constexpr std::uint64_t kVisited = 3;
    for (std::uint64_t k = 0; k < kVisited; ++k)
      next(list[((path_ >> 7) * (k + 1) + path_ * k) % list.size()]);
  }

  template <typename Element, std::size_t kSize>
  void walk(boost::array<Element, kSize>& list) {
    for (Element& element : list) next(element);
  }

  template <typename Message>
  void walk(Message& message) {
    ros::serialization::Serializer<Message>::template allInOne<MessageWalk, Message&>(*this, message);
  }

  std::uint64_t path_;
  std::size_t chosen_;
  Choice* choice_;
  std::size_t places_ = 0;
};

/// Changes a message at one to four places.
template <typename Message>
void mutate(Message* message, Choice* choice) {
  std::size_t changes = 1;
  while (changes < 4 && choice->oneIn(3)) ++changes;
  for (; changes > 0; --changes) {
    const std::uint64_t path = choice->bits();
    MessageWalk count(path, MessageWalk::kNowhere, choice);
    count.next(*message);
    if (count.places() == 0) return;
    MessageWalk walk(path, choice->below(count.places()), choice);
    walk.next(*message);
  }
}

}  // namespace softbody::fuzz
