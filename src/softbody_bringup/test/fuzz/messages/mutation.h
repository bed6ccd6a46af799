#pragma once

#include <ros/serialization.h>
#include <ros/time.h>

#include <boost/array.hpp>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <type_traits>
#include <vector>

namespace softbody::fuzz {

/// Seeded choices, the same on every machine.
class Choice {
 public:
  explicit Choice(std::uint64_t seed) : engine_(seed) {}

  std::uint64_t bits() { return engine_(); }
  /// 0 to count - 1. @param count above 0.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }
  bool oneIn(std::size_t count) { return below(count) == 0; }

 private:
  std::mt19937_64 engine_;
};

/// Numbers, texts and times that a sender should not send, made from what is there.
void change(float* value, Choice* choice);
void change(double* value, Choice* choice);
void change(std::string* value, Choice* choice);
void change(ros::Time* value, Choice* choice);
void change(ros::Duration* value, Choice* choice);

template <typename Integer, typename = std::enable_if_t<std::is_integral_v<Integer>>>
void change(Integer* value, Choice* choice) {
  using Unsigned = std::make_unsigned_t<Integer>;
  constexpr auto kMost = static_cast<Unsigned>(std::numeric_limits<Integer>::max());
  const auto old = static_cast<Unsigned>(*value);
  const Unsigned odd[] = {0,
                          1,
                          kMost,
                          static_cast<Unsigned>(kMost / 2 + 1),
                          static_cast<Unsigned>(~Unsigned{0}),
                          static_cast<Unsigned>(old + 1),
                          static_cast<Unsigned>(old - 1),
                          static_cast<Unsigned>(2 * old),
                          static_cast<Unsigned>(old ^ (Unsigned{1} << choice->below(8 * sizeof(Integer)))),
                          static_cast<Unsigned>(choice->below(16)),
                          static_cast<Unsigned>(choice->bits())};
  *value = static_cast<Integer>(odd[choice->below(std::size(odd))]);
}

/// Empties, shortens, lengthens or mixes a list.
template <typename Element>
void changeList(std::vector<Element>* list, Choice* choice) {
  constexpr std::size_t kLongest = 20'000;
  const std::size_t size = list->size();
  switch (choice->below(8)) {
    case 0:
      return list->clear();
    case 1:
      return list->resize(choice->below(size + 1));
    case 2:
      return list->resize(size + 1);
    case 3:
      return list->resize(size + choice->below(choice->oneIn(20) ? kLongest : 10));
    case 4:
      if (size > 0) list->pop_back();
      return;
    case 5:
      if (size > 0) list->push_back(Element((*list)[choice->below(size)]));
      return;
    case 6:
      if (size > 0) std::swap((*list)[choice->below(size)], (*list)[choice->below(size)]);
      return;
    default:
      if (2 * size > kLongest) return;
      const std::vector<Element> copy = *list;
      list->insert(list->end(), copy.begin(), copy.end());
  }
}

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
