#include <gtest/gtest.h>

#include "tracker/search_pace.h"

namespace softbody {
namespace {

/// The frames of so many in which a search is due.
std::vector<int> dueFrames(SearchPace* pace, int frames) {
  std::vector<int> due;
  for (int i = 0; i < frames; ++i) {
    if (pace->isDue()) due.push_back(i);
  }
  return due;
}

TEST(SearchPace, SearchesInVainComeLessAndLessOften) {
  SearchPace pace;
  EXPECT_EQ(dueFrames(&pace, 40), std::vector<int>({0, 2, 6, 14, 24, 34}));
}

TEST(SearchPace, StartsAnewAfterThePieceWasFound) {
  SearchPace pace;
  dueFrames(&pace, 18);
  pace.reset();
  EXPECT_EQ(dueFrames(&pace, 10), std::vector<int>({0, 2, 6}));
}

}  // namespace
}  // namespace softbody
