#include <test_support/gtest.h>
#include <yaml-cpp/yaml.h>

#include "softbody_common/parameters/parameter_table.h"

namespace softbody {
namespace {

enum class Mode { kFast, kExact };

struct Part {
  double weight = 0.5;
};

struct Options {
  int count = 3;
  double limit = 1e-6;
  std::optional<double> size;
  bool on = true;
  std::string name;
  std::string path;
  Mode mode = Mode::kExact;
  std::string word = "one";
  Eigen::Vector3d gravity{0.0, 0.0, -9.81};
  std::vector<std::string> others;
  Nanoseconds wait = 15'000'000;
  Part part;
};

ParameterTable<Options> makeTable() {
  ParameterTable<Part> part;
  part.group("part");
  part.number("weight", &Part::weight, {0.0, 1.0}, "", "a weight", Change::kLive);
  ParameterTable<Options> table;
  table.group("all");
  table.requiredText("path", &Options::path, "see [there](there.md) or `here`");
  table.number("count", &Options::count, {0, 9}, "", "how many", Change::kLive);
  table.number("limit", &Options::limit, {0.0, 1.0}, "m", "how far");
  table.number("size", &Options::size, {1.0, 2.0}, "m", "from the file", "how large", Change::kLive);
  table.flag("on", &Options::on, "whether");
  table.text("name", &Options::name, "who");
  table.choice<Mode>("mode", &Options::mode, {{"fast", Mode::kFast}, {"exact", Mode::kExact}}, "how");
  table.choice("word", &Options::word, {"one", "two"}, "which");
  table.numbers("gravity", &Options::gravity, "m/s²", "three numbers", "down");
  table.texts("others", &Options::others, "who else");
  table.seconds("wait_s", &Options::wait, {0.0, 1.0}, "how long");
  table.part(&Options::part, part);
  table.check([](const Options& options) {
    if (options.count == 7 && options.part.weight == 0.0) throw std::invalid_argument("7 needs a weight");
  });
  return table;
}

Parameters nodeGiven(const std::string& yaml) { return Parameters(YAML::Load(yaml), "/node/"); }

/// @return the reason why a live change is refused.
std::string refusalOfChange(const std::string& yaml) {
  return complaint([&] {
    Parameters change = nodeGiven(yaml);
    makeTable().change(change, Options());
  });
}

TEST(ParameterTable, ReadsEveryKindIntoItsMember) {
  Parameters all = nodeGiven(
      "{path: a, count: 5, limit: 0.5, size: 1.5, on: false, name: b, mode: fast, word: two, "
      "gravity: [1, 2, 3], others: [c, d], wait_s: 0.25, weight: 0.75}");
  const Options options = makeTable().read(all);
  EXPECT_TRUE(all.unknown().empty());
  EXPECT_EQ(options.path, "a");
  EXPECT_EQ(options.count, 5);
  EXPECT_EQ(options.limit, 0.5);
  EXPECT_EQ(options.size, 1.5);
  EXPECT_FALSE(options.on);
  EXPECT_EQ(options.name, "b");
  EXPECT_EQ(options.mode, Mode::kFast);
  EXPECT_EQ(options.word, "two");
  EXPECT_EQ(options.gravity, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(options.others, (std::vector<std::string>{"c", "d"}));
  EXPECT_EQ(options.wait, 250'000'000);
  EXPECT_EQ(options.part.weight, 0.75);
}

TEST(ParameterTable, KeepsTheInitialValuesOfWhatIsNotGiven) {
  Parameters nothing = nodeGiven("{path: a}");
  const Options options = makeTable().read(nothing), usual;
  EXPECT_EQ(options.count, usual.count);
  EXPECT_EQ(options.limit, usual.limit);
  EXPECT_FALSE(options.size);
  EXPECT_EQ(options.mode, usual.mode);
  EXPECT_EQ(options.gravity, usual.gravity);
  EXPECT_EQ(options.wait, usual.wait);
  EXPECT_EQ(options.part.weight, usual.part.weight);
}

TEST(ParameterTable, RefusesAsParametersDoAndChecksTheWhole) {
  for (const auto& [yaml, key] :
       {std::pair("{path: a, count: 10}", "/node/count is 10; allowed: 0 to 9"),
        std::pair("{path: a, mode: magic}", "/node/mode is 'magic'"),
        std::pair("{}", "/node/path is missing"), std::pair("{path: a, weight: 2}", "/node/weight is 2"),
        std::pair("{path: a, count: 7, weight: 0}", "7 needs a weight")}) {
    const std::string why = complaint([text = yaml] {
      Parameters bad = nodeGiven(text);
      makeTable().read(bad);
    });
    EXPECT_TRUE(says(why, key)) << yaml;
  }
}

TEST(ParameterTable, ChangesOnlyWhatIsGivenAndLive) {
  Options now;
  now.path = "a";
  now.limit = 0.25;
  Parameters change = nodeGiven("{count: 4, weight: 1, size: 2}");
  const Options next = makeTable().change(change, now);
  EXPECT_EQ(next.count, 4);
  EXPECT_EQ(next.part.weight, 1.0);
  EXPECT_EQ(next.size, 2.0);
  EXPECT_EQ(next.limit, 0.25);
  EXPECT_EQ(next.path, "a");
  EXPECT_TRUE(says(refusalOfChange("{count: -1}"), "/node/count is -1; allowed: 0 to 9"));
  EXPECT_TRUE(says(refusalOfChange("{limit: 0.5}"), "/node/limit cannot change"));
  EXPECT_TRUE(says(refusalOfChange("{nothing: 1}"), "/node/nothing cannot change"));
  EXPECT_NE(refusalOfChange("{count: 7, weight: 0}"), "");
}

TEST(ParameterTable, GivesTheLiveValuesThatAreSet) {
  Options options;
  EXPECT_EQ(makeTable().liveValues(options),
            (std::map<std::string, ParameterValue>{{"count", 3}, {"weight", 0.5}}));
  options.size = 1.25;
  EXPECT_EQ(makeTable().liveValues(options).at("size"), ParameterValue(1.25));
}

TEST(ParameterTable, DescribesItselfAsAMarkdownTable) {
  EXPECT_EQ(markdownTable(makeTable().describe()),
            "| parameter | default | unit | range | live | meaning |\n"
            "|---|---|---|---|---|---|\n"
            "| path | (required) | | | | see [there](there.md) or `here` |\n"
            "| count | 3 | | 0 to 9 | yes | how many |\n"
            "| limit | 1e-6 | m | 0 to 1 | | how far |\n"
            "| size | from the file | m | 1 to 2 | yes | how large |\n"
            "| on | true | | | | whether |\n"
            "| name | (none) | | | | who |\n"
            "| mode | exact | | fast, exact | | how |\n"
            "| word | one | | one, two | | which |\n"
            "| gravity | [0, 0, -9.81] | m/s² | three numbers | | down |\n"
            "| others | [] | | list | | who else |\n"
            "| wait_s | 0.015 | s | 0 to 1 | | how long |\n"
            "| weight | 0.5 | | 0 to 1 | yes | a weight |\n");
  EXPECT_EQ(makeTable().describe().back().group, "part");
  EXPECT_EQ(withoutMarkdown("see [there](there.md) or `here`"), "see there or here");
}

TEST(ParameterDescription, WritesNumbersAsPeopleDo) {
  for (const auto& [number, text] :
       {std::pair(20.0, "20"), std::pair(2e-4, "0.0002"), std::pair(1e-6, "1e-6"), std::pair(1e12, "1e12"),
        std::pair(0.1, "0.1"), std::pair(-1.5e-10, "-1.5e-10"), std::pair(1073741824.0, "1073741824")})
    EXPECT_EQ(toText(number), text);
}

}  // namespace
}  // namespace softbody
