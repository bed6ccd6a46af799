#include "softbody_evaluation/tools/evaluate.h"

#include <test_support/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fixtures/evaluator_bags.h"

namespace softbody::evaluation {
namespace {

/// What the tool prints on stdout.
std::string printed(std::vector<std::string> words) {
  words.insert(words.begin(), "evaluate");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  testing::internal::CaptureStdout();
  const int code = runEvaluate(static_cast<int>(arguments.size()), arguments.data());
  std::string text = testing::internal::GetCapturedStdout();
  EXPECT_EQ(code, 0) << text;
  return text;
}

std::string goodResult() { return resultFromTruth("printed.bag", asItIs); }

TEST(Evaluate, PrintsTheVerdictFirstThenAShortTableThenThePage) {
  const std::string folder = testing::TempDir() + "printed_report";
  const std::string text = printed({goodResult(), "--truth", recording(), "--report", folder});
  EXPECT_EQ(text.find("verdict: good\n"), 0u) << text;
  EXPECT_TRUE(says(text, "visible vertices, mean"));
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 30) << text;
  const std::size_t page = text.rfind("report: ");
  ASSERT_NE(page, std::string::npos) << text;
  const std::string path = text.substr(page + 8, text.size() - page - 9);
  EXPECT_TRUE(std::filesystem::path(path).is_absolute()) << path;
  EXPECT_TRUE(std::filesystem::exists(path)) << path;
}

TEST(Evaluate, ABadMetricIsMarkedAndExplained) {
  const std::string result =
      resultFromTruth("printed_beside.bag", [](softbody_msgs::MeshState* s, int) { return shift(s, 0.15f); });
  const std::string text = printed({result, "--truth", recording()});
  EXPECT_EQ(text.find("verdict: wrong\n"), 0u) << text;
  EXPECT_TRUE(says(text, "<- wrong"));
  EXPECT_TRUE(says(text, "--report"));
}

TEST(Evaluate, JsonIsAloneOnStdout) {
  const nlohmann::json one = nlohmann::json::parse(printed({goodResult(), "--truth", recording(), "--json"}));
  EXPECT_EQ(one["verdict"]["level"], "good");
  const nlohmann::json two = nlohmann::json::parse(
      printed({goodResult(), "--truth", recording(), "--compare", goodResult(), "--json"}));
  EXPECT_EQ(two["other"]["frames"]["answered"], kFrames);
}

TEST(Evaluate, BothVerdictsStandBesideTheComparison) {
  const std::string other =
      resultFromTruth("printed_other.bag", [](softbody_msgs::MeshState* s, int) { return shift(s, 0.15f); });
  const std::string text = printed({goodResult(), "--truth", recording(), "--compare", other});
  EXPECT_TRUE(says(text, "verdict: good"));
  EXPECT_TRUE(says(text, "verdict: wrong"));
  EXPECT_TRUE(says(text, "difference"));
}

TEST(Evaluate, WindowsOfTheDepthResidualAreARowEach) {
  const std::string text = printed({goodResult(), "--truth", recording(), "--window", "5"});
  for (const char* row : {"0-4", "5-9", "10-14", "15-19"}) EXPECT_TRUE(says(text, row));
}

TEST(Evaluate, TwoModelsAreComparedInsteadOfBags) {
  const std::string sponge = std::string(CONFIG_DIR) + "/sponge.yaml";
  const nlohmann::json json = nlohmann::json::parse(printed({"--model", sponge, sponge, "--json"}));
  EXPECT_LT(json["whole"]["true_to_scanned"]["max_mm"], 0.1);
  EXPECT_NEAR(json["volume_ratio"].get<double>(), 1.0, 1e-9);
  EXPECT_TRUE(says(printed({"--model", sponge, sponge, "--aligned"}), "whole surface"));
}

TEST(Evaluate, NeedsBagsOrModelsAndNotBoth) {
  const auto code = [](std::vector<std::string> words) {
    words.insert(words.begin(), "evaluate");
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    return runEvaluate(static_cast<int>(arguments.size()), arguments.data());
  };
  EXPECT_EQ(code({}), 2);
  EXPECT_EQ(code({recording(), "--model", "a.obj", "b.obj"}), 2);
  EXPECT_EQ(code({"--aligned", recording()}), 2);
  EXPECT_EQ(code({"--model", "/nowhere/a.obj", "/nowhere/b.obj"}), 1);
}

}  // namespace
}  // namespace softbody::evaluation
