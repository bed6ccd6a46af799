#include "softbody_common/protocol/tracking_state.h"

#include <gtest/gtest.h>

namespace softbody {
namespace {

TEST(AlikeReason, IsReadBackAlsoAmongOtherReasons) {
  for (const int poses : {2, 4, 17}) {
    EXPECT_EQ(posesAlike(alikeReason(poses)), poses);
    EXPECT_EQ(posesAlike("no state for 1.0 s; " + alikeReason(poses) + "; few features"), poses);
  }
}

TEST(AlikeReason, OtherReasonsNameOnePose) {
  for (const char* reason :
       {"", "few features", "tracked in one of", "tracked in one of many poses that look alike",
        "tracked in one of 4 rooms", "tracked in one of -3 poses that look alike"})
    EXPECT_EQ(posesAlike(reason), 1) << reason;
}

}  // namespace
}  // namespace softbody
