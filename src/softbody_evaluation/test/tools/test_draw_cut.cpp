#include "softbody_evaluation/tools/draw_cut.h"

#include <test_support/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "fixtures/evaluator_bags.h"

namespace softbody::evaluation {
namespace {

TEST(DrawCut, AResultInAnotherFrameThanTheImagesIsRefused) {
  const std::string result = resultFromTruth("drawn.bag", [](softbody_msgs::MeshState* s, int) {
    s->header.frame_id = "world";
    return true;
  });
  const std::string picture = testing::TempDir() + "refused.png";
  std::vector<std::string> words{"draw_cut", result, "--recording", recording(), "--output", picture};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  testing::internal::CaptureStderr();
  EXPECT_EQ(runDrawCut(static_cast<int>(arguments.size()), arguments.data()), 1);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_TRUE(says(errors, "the surface is in frame 'world'"));
  EXPECT_FALSE(std::filesystem::exists(picture));
}

}  // namespace
}  // namespace softbody::evaluation
