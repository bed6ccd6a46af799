#pragma once

#include <ros/time.h>

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

}  // namespace softbody::fuzz
