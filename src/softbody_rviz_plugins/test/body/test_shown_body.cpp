#include <gtest/gtest.h>

#include <memory>

#include "body/shown_body.h"

namespace softbody {
namespace {

struct Message {
  unsigned revision;
  int content = 0;
};
using Ptr = std::shared_ptr<const Message>;

Ptr make(unsigned revision, int content = 0) {
  return std::make_shared<const Message>(Message{revision, content});
}

bool same(const Message& a, const Message& b) { return a.revision == b.revision && a.content == b.content; }

TEST(ShownBody, aStateIsHeldUntilItsTopologyHasCome) {
  ShownBody<Ptr, Ptr> body;
  body.putState(make(1));
  EXPECT_FALSE(body.take(same));
  EXPECT_EQ(body.heldRevision(), 1u);
  body.putTopology(make(0));
  EXPECT_FALSE(body.take(same));
  const Ptr topology = make(1), state = make(1, 7);
  body.putTopology(topology);
  body.putState(state);
  const auto news = body.take(same);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->topology, topology);
  EXPECT_EQ(news->state, state);
  EXPECT_FALSE(body.heldRevision());
}

TEST(ShownBody, aTopologyThatIsSentAgainIsNotNews) {
  ShownBody<Ptr, Ptr> body;
  body.putTopology(make(0));
  body.putState(make(0));
  ASSERT_TRUE(body.take(same)->topology);
  for (int second = 0; second < 3; ++second) {
    body.putTopology(make(0));
    EXPECT_FALSE(body.take(same)) << "nothing to draw";
    body.putState(make(0));
    EXPECT_FALSE(body.take(same)->topology);
  }
}

TEST(ShownBody, anotherBodyOfTheSameRevisionIsNews) {
  ShownBody<Ptr, Ptr> body;
  body.putTopology(make(0));
  body.putState(make(0));
  body.take(same);
  const Ptr other = make(0, 1);
  body.putTopology(other);
  body.putState(make(0));
  EXPECT_EQ(body.take(same)->topology, other);
}

TEST(ShownBody, theOldRevisionIsDrawnUntilAStateOfTheNewOneComes) {
  ShownBody<Ptr, Ptr> body;
  body.putTopology(make(0));
  body.putState(make(0));
  body.take(same);
  const Ptr next = make(1);
  body.putTopology(next);
  body.putState(make(0, 5));
  auto news = body.take(same);
  ASSERT_TRUE(news);
  EXPECT_FALSE(news->topology);
  EXPECT_EQ(news->state->content, 5);
  body.putState(make(1));
  news = body.take(same);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->topology, next);
}

}  // namespace
}  // namespace softbody
