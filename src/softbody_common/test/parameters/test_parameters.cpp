#include <test_support/gtest.h>
#include <yaml-cpp/yaml.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "softbody_common/parameters/parameters.h"

namespace softbody {
namespace {

Parameters given(const std::string& yaml) { return Parameters(YAML::Load(yaml), "/node/"); }

/// The sentence that a reader fails with.
std::string failure(const std::string& yaml, const std::function<void(Parameters&)>& read) {
  Parameters parameters = given(yaml);
  return complaint([&] { read(parameters); });
}

TEST(Parameters, MissingKeysGiveTheFallback) {
  for (Parameters parameters : {Parameters(), given("{}"), given("")}) {
    EXPECT_EQ(parameters.number("a", 1.5, 0.0, 2.0), 1.5);
    EXPECT_EQ(parameters.integer("a", 3, 0, 5), 3);
    EXPECT_TRUE(parameters.flag("a", true));
    EXPECT_EQ(parameters.text("a", "x"), "x");
    EXPECT_EQ(parameters.choice("a", "x", {"x", "y"}), "x");
    EXPECT_EQ(parameters.numbers("a", {1.0, 2.0}), (std::vector<double>{1.0, 2.0}));
    EXPECT_TRUE(parameters.texts("a").empty());
    EXPECT_TRUE(parameters.unknown().empty());
  }
}

TEST(Parameters, GivenValuesAreRead) {
  Parameters parameters = given("{n: 2, x: 0.25, on: false, word: y, list: [3, 4.5], words: [/a, b]}");
  EXPECT_EQ(parameters.number("n", 0.0, 0.0, 5.0), 2.0);
  EXPECT_EQ(parameters.number("x", 0.0, 0.0, 5.0), 0.25);
  EXPECT_EQ(parameters.integer("n", 0, 0, 5), 2);
  EXPECT_FALSE(parameters.flag("on", true));
  EXPECT_EQ(parameters.choice("word", "x", {"x", "y"}), "y");
  EXPECT_EQ(parameters.requiredText("word"), "y");
  EXPECT_EQ(parameters.numbers("list", {0.0, 0.0}), (std::vector<double>{3.0, 4.5}));
  EXPECT_EQ(parameters.texts("words"), (std::vector<std::string>{"/a", "b"}));
}

TEST(Parameters, RangesIncludeTheirEnds) {
  const auto number = [](Parameters& p) { p.number("x", 1.0, 0.5, 2.0); };
  for (const char* good : {"x: 0.5", "x: 2", "x: 2.0"}) EXPECT_EQ(failure(good, number), "") << good;
  for (const char* bad : {"x: 0.4999", "x: 2.0001", "x: .nan", "x: .inf", "x: -.inf"}) {
    EXPECT_TRUE(says(failure(bad, number), "/node/x")) << bad;
  }
  const auto integer = [](Parameters& p) { p.integer("x", 1, -1, 4); };
  for (const char* good : {"x: -1", "x: 4"}) EXPECT_EQ(failure(good, integer), "") << good;
  for (const char* bad : {"x: -2", "x: 5", "x: 1.5", "x: 99999999999"})
    EXPECT_NE(failure(bad, integer), "") << bad;
}

TEST(Parameters, SentencesHoldKeyValueAndWhatIsAllowed) {
  const std::string sentence = failure("x: 7", [](Parameters& p) { p.number("x", 1.0, 0.5, 2.0); });
  for (const char* part : {"/node/x", "7", "0.5", "2"}) EXPECT_TRUE(says(sentence, part)) << part;
  const std::string choice = failure("x: z", [](Parameters& p) { p.choice("x", "a", {"a", "b"}); });
  for (const char* part : {"/node/x", "z", "a, b"}) EXPECT_TRUE(says(choice, part)) << part;
}

TEST(Parameters, WrongTypesAreRefused) {
  for (const char* bad : {"x: word", "x: [1]", "x: {a: 1}", "x:"}) {
    EXPECT_NE(failure(bad, [](Parameters& p) { p.number("x", 1.0, 0.0, 2.0); }), "") << bad;
    EXPECT_NE(failure(bad, [](Parameters& p) { p.integer("x", 1, 0, 2); }), "") << bad;
    EXPECT_NE(failure(bad, [](Parameters& p) { p.flag("x", true); }), "") << bad;
    EXPECT_NE(failure(bad, [](Parameters& p) { p.numbers("x", {1.0, 2.0}); }), "") << bad;
  }
  for (const char* bad : {"x: [1]", "x: {a: 1}"}) {
    EXPECT_NE(failure(bad, [](Parameters& p) { p.text("x", ""); }), "") << bad;
  }
  for (const char* bad : {"x: word", "x: {a: 1}", "x: [a, '']"}) {
    EXPECT_NE(failure(bad, [](Parameters& p) { p.texts("x"); }), "") << bad;
  }
  for (const char* bad : {"x: [1, 2, 3]", "x: [1, .nan]", "x: [1, word]"}) {
    EXPECT_NE(failure(bad, [](Parameters& p) { p.numbers("x", {1.0, 2.0}); }), "") << bad;
  }
  EXPECT_NE(failure("y: 1", [](Parameters& p) { p.requiredText("x"); }), "");
  EXPECT_THROW(given("[1, 2]"), std::invalid_argument);
  EXPECT_THROW(given("word"), std::invalid_argument);
}

TEST(Parameters, OnlyKeysThatNobodyAskedForAreUnknown) {
  Parameters parameters = given("{a: 1, b: 2, c: 3}");
  parameters.number("b", 0.0, 0.0, 9.0);
  parameters.number("d", 0.0, 0.0, 9.0);
  EXPECT_EQ(parameters.unknown(), (std::vector<std::string>{"/node/a", "/node/c"}));
}

}  // namespace
}  // namespace softbody
