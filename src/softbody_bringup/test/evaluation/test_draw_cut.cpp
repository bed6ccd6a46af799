#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "fixtures/evaluator_bags.h"

namespace softbody::evaluation {
namespace {

TEST(DrawCut, AResultInAnotherFrameThanTheImagesIsRefused) {
  const std::string result = resultFromTruth("drawn.bag", [](softbody_msgs::MeshState* s, int) {
    s->header.frame_id = "world";
    return true;
  });
  const std::string picture = testing::TempDir() + "refused.png", words = testing::TempDir() + "refused.txt";
  const int status = std::system(fmt::format("'{}' '{}' --recording '{}' --output '{}' 2> '{}'", DRAW_CUT,
                                             result, recording(), picture, words)
                                     .c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  std::stringstream said;
  said << std::ifstream(words).rdbuf();
  EXPECT_NE(said.str().find("the surface is in frame 'world'"), std::string::npos) << said.str();
  EXPECT_FALSE(std::filesystem::exists(picture));
}

}  // namespace
}  // namespace softbody::evaluation
