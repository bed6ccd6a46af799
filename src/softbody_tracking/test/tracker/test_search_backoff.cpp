#include <gtest/gtest.h>

#include "tracker/search_backoff.h"

namespace softbody {
namespace {

/// The frames in which a search is due, out of a number of frames.
std::vector<int> dueFrames(SearchBackoff* backoff, int frames) {
  std::vector<int> due;
  for (int i = 0; i < frames; ++i) {
    if (backoff->isDue()) due.push_back(i);
  }
  return due;
}

TEST(SearchBackoff, WaitsLongerAfterEachFailure) {
  SearchBackoff backoff;
  EXPECT_EQ(dueFrames(&backoff, 40), std::vector<int>({0, 2, 6, 14, 24, 34}));
}

TEST(SearchBackoff, SearchesAtOnceAfterThePieceWasFound) {
  SearchBackoff backoff;
  dueFrames(&backoff, 18);
  backoff.reset();
  EXPECT_EQ(dueFrames(&backoff, 10), std::vector<int>({0, 2, 6}));
}

}  // namespace
}  // namespace softbody
