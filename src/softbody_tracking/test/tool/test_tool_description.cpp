#include <test_support/gtest.h>
#include <test_support/scratch_folder.h>

#include <cmath>
#include <filesystem>

#include "softbody_tracking/tool/tool_description.h"

namespace softbody {
namespace {

class ToolDescriptionTest : public testing::Test {
 protected:
  std::string file(const std::string& text) const { return folder_.write("tool.yaml", text); }

  std::string refusal(const std::string& text) {
    return complaint([&] { loadToolDescription(file(text)); });
  }

  const test::ScratchFolder folder_;
};

const char kMarker[] = "{id: 7, size_m: 0.064, pose: [0.1, 0, 0, 0, 0, 0, 1]}";

std::string tool(const std::string& dictionary, const std::string& markers, const std::string& rest = "") {
  return "tool:\n  dictionary: " + dictionary + "\n  markers: [" + markers + "]\n" + rest;
}

/// A blade with this many corners.
std::string circle(int corners) {
  std::string list;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * M_PI * i / corners;
    list += (i == 0 ? "[0, " : ", [0, ") + std::to_string(0.1 * std::cos(angle)) + ", " +
            std::to_string(0.1 * std::sin(angle)) + "]";
  }
  return "[" + list + "]";
}

TEST_F(ToolDescriptionTest, AGoodFileIsRead) {
  const ToolDescription description = loadToolDescription(
      file(tool("DICT_5X5_100", kMarker, "  blade: [[0, 0, 0], [0, 0.05, 0], [0, 0.05, 0.1]]\n")));
  EXPECT_EQ(description.dictionary, "DICT_5X5_100");
  ASSERT_EQ(description.markers.size(), 1u);
  EXPECT_EQ(description.markers[0].id, 7);
  EXPECT_DOUBLE_EQ(description.markers[0].size_m, 0.064);
  EXPECT_EQ(description.blade.rows(), 3);
  EXPECT_TRUE(description.warnings.empty());
  Eigen::Matrix<double, 3, 4> corners;
  corners << 0.068, 0.132, 0.132, 0.068, 0.032, 0.032, -0.032, -0.032, 0, 0, 0, 0;
  EXPECT_TRUE(markerCorners(description.markers[0]).isApprox(corners, 1e-12));
}

TEST_F(ToolDescriptionTest, AFrameOfTfMayTakeThePlaceOfMarkers) {
  const std::string blade = "  blade: [[0, 0, 0], [0, 0.05, 0], [0, 0.05, 0.1]]\n";
  const ToolDescription knife = loadToolDescription(file("tool:\n  frame: knife_link\n" + blade));
  EXPECT_EQ(knife.frame, "knife_link");
  EXPECT_TRUE(knife.markers.empty());
  EXPECT_EQ(knife.blade.rows(), 3);
  EXPECT_TRUE(knife.warnings.empty());
  EXPECT_THROW(loadToolWithMarkers(file("tool:\n  frame: knife_link\n" + blade)), std::invalid_argument);

  EXPECT_TRUE(says(refusal(tool("DICT_4X4_50", kMarker, "  frame: knife_link\n")), "frame and markers"));
  EXPECT_TRUE(says(refusal("tool: {frame: [knife_link]}"), "tool/frame must be a text"));

  const ToolDescription marked = loadToolWithMarkers(file(tool("DICT_4X4_50", kMarker, blade)));
  EXPECT_EQ(inFrame(marked, "").markers.size(), 1u);
  const ToolDescription carried = inFrame(marked, "tool0");
  EXPECT_EQ(carried.frame, "tool0");
  EXPECT_TRUE(carried.markers.empty());
  EXPECT_EQ(carried.blade, marked.blade);
}

TEST_F(ToolDescriptionTest, TheBladeIsOptionalAndUnknownKeysAreWarnedOf) {
  const ToolDescription description =
      loadToolDescription(file(tool("DICT_4X4_50", "{id: 1, size_m: 0.02, colour: red}", "  balde: []\n")));
  EXPECT_EQ(description.blade.rows(), 0);
  ASSERT_EQ(description.warnings.size(), 2u);
  EXPECT_TRUE(says(description.warnings[0], "tool/markers[0]/colour"));
  EXPECT_TRUE(says(description.warnings[1], "tool/balde"));
}

TEST_F(ToolDescriptionTest, BadFilesAreRefusedWithKeyAndValue) {
  const std::string blade = "  blade: ";
  const struct {
    std::string text;
    std::vector<std::string> words;
  } cases[] = {
      {"objct: {}", {"'tool' is missing"}},
      {tool("DICT_3X3", kMarker), {"tool/dictionary", "DICT_3X3", "DICT_4X4_50"}},
      {tool("mine.yml", kMarker), {"tool/dictionary", "mine.yml"}},
      {tool("DICT_4X4_50", ""), {"tool/markers", "at least one"}},
      {tool("DICT_4X4_50", "{id: 50, size_m: 0.06}"), {"tool/markers[0]/id", "'50'", "0 to 49"}},
      {tool("DICT_4X4_50", "{id: 5}"), {"tool/markers[0]/size_m", "missing"}},
      {tool("DICT_4X4_50", "{id: 5, size_m: -1}"), {"tool/markers[0]/size_m", "'-1'"}},
      {tool("DICT_4X4_50", "{id: 5, size_m: 64}"), {"tool/markers[0]/size_m", "'64'"}},
      {tool("DICT_4X4_50", "{id: 5, size_m: 0.06, pose: [0, 0, 0, 0, 0, 0, 2]}"), {"pose", "length 2"}},
      {tool("DICT_4X4_50", std::string(kMarker) + ", " + kMarker), {"tool/markers[1]/id", "7", "differ"}},
      {tool("DICT_4X4_50", kMarker, blade + "[[0, 0, 0], [1, 0, 0]]\n"), {"tool/blade", "three"}},
      {tool("DICT_4X4_50", kMarker, blade + circle(65) + "\n"), {"tool/blade", "three to 64"}},
      {tool("DICT_4X4_50", kMarker, blade + "[[0, 0, 0], [1, 0, 0], [1, x, 0]]\n"), {"tool/blade[2]", "x"}},
      {tool("DICT_4X4_50", kMarker, blade + "[[0, 0, 0], [1, 0, 0], [.inf, 1, 0]]\n"), {"tool/blade[2]"}},
      {tool("DICT_4X4_50", kMarker, blade + "[[0, 0, 0], [0, 8, 0], [0, 8, 5]]\n"),
       {"tool/blade", "9.434 m", "up to 2 m", "metres"}},
      {tool("DICT_4X4_50", kMarker, blade + "[[0, -100, -20], [0, -145, -20], [0, -145, -150]]\n"),
       {"metres"}},
      {tool("DICT_4X4_50", "{id: 5, size_m: 0.06, pose: [0, 64, 0, 0, 0, 0, 1]}",
            blade + "[[0, 0, 0], [0, 0.1, 0], [0, 0.1, 0.1]]\n"),
       {"tool/markers", "64", "metres"}},
      {tool("DICT_4X4_50", kMarker, blade + "[[0, 0, 0], [0.1, 0, 0], [0.2, 0, 0]]\n"), {"no area"}},
      {tool("DICT_4X4_50", kMarker, blade + "[[0, 0, 0], [0.1, 0, 0], [0.1, 0.1, 0], [0, 0.1, 0.05]]\n"),
       {"not planar"}},
  };
  for (const auto& bad : cases) {
    SCOPED_TRACE(bad.text);
    const std::string message = refusal(bad.text);
    EXPECT_TRUE(says(message, "tool.yaml:"));
    for (const std::string& word : bad.words) EXPECT_TRUE(says(message, word));
  }
  EXPECT_THROW(loadToolDescription("/nowhere/tool.yaml"), std::invalid_argument);
}

}  // namespace
}  // namespace softbody
