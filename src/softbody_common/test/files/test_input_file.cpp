#include "softbody_common/files/input_file.h"

#include <sys/stat.h>
#include <test_support/gtest.h>
#include <yaml-cpp/yaml.h>

#include <functional>
#include <stdexcept>

#include <test_support/scratch_folder.h>
#include "softbody_common/files/staged_output.h"
#include "softbody_common/files/yaml_map_reader.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;
using test::ScratchFolder;

TEST(ReadFile, RefusesWhatIsNoRegularFileAtOnce) {
  const ScratchFolder folder;
  mkfifo((folder / "pipe").c_str(), 0600);
  for (const fs::path& path :
       {folder / "pipe", fs::path(folder), fs::path("/dev/zero"), folder / "nothing"}) {
    EXPECT_TRUE(says(complaint([&] { readFile(path); }), path.string() + ": cannot be read: ")) << path;
  }
}

TEST(ReadTextFile, HasNoMarkAndOneKindOfLineEnds) {
  const ScratchFolder folder;
  replaceFile(folder / "a",
              "\xef\xbb\xbf"
              "a\r\nb\rc\n\nd\r");
  EXPECT_EQ(readTextFile(folder / "a"), "a\nb\nc\n\nd\n");
  for (const char* mark : {"\xff\xfe", "\xfe\xff"}) {
    replaceFile(folder / "wide", mark + std::string("\0v\0", 4));
    EXPECT_TRUE(
        says(complaint([&] { readTextFile(folder / "wide"); }), "wide: is UTF-16 text; save it as UTF-8"));
  }
}

TEST(WithoutComment, KeepsTheSignWithinAWord) {
  EXPECT_EQ(withoutComment("# a"), "");
  EXPECT_EQ(withoutComment("v 1.#QNAN 2 # a # b"), "v 1.#QNAN 2 ");
}

TEST(IsInside, TakesAnEmptyPathForTheCurrentFolder) {
  EXPECT_TRUE(isInside("a.obj", ""));
  EXPECT_FALSE(isInside("../a.obj", ""));
}

TEST(ParseYamlFile, SkipsAByteOrderMark) {
  const ScratchFolder folder;
  replaceFile(folder / "a.yaml", "\xef\xbb\xbfobject:\r\n  unit: mm\r\n");
  EXPECT_EQ(parseYamlFile((folder / "a.yaml").string())["object"]["unit"].as<std::string>(), "mm");
}

TEST(IsInside, ResolvesLinksAndDots) {
  const ScratchFolder folder;
  fs::create_directories(folder / "data/meshes");
  replaceFile(folder / "secret", "");
  fs::create_symlink(folder / "secret", folder / "data/link");
  fs::create_symlink(folder / "data/meshes", folder / "data/also");
  fs::create_directory_symlink(folder / "data", folder / "alias");
  for (const char* name : {"a.obj", "meshes/a.obj", "meshes/../a.obj", "also/a.obj", "..a/b", "."}) {
    EXPECT_TRUE(isInside(folder / "data" / name, folder / "data")) << name;
    EXPECT_TRUE(isInside(folder / "alias" / name, folder / "data")) << name;
  }
  for (const char* name : {"..", "../secret", "link", "meshes/../../secret", "/etc/passwd", "../data2/a"})
    EXPECT_FALSE(isInside(folder / "data" / name, folder / "data")) << name;
}

TEST(YamlMapReader, AFileOutsideOfItsFolderNeedsAllowance) {
  const ScratchFolder folder;
  fs::create_directory(folder / "data");
  replaceFile(folder / "secret.obj", "");
  replaceFile(folder / "data/own.obj", "");
  replaceFile(folder / "data/object.yaml", "own: own.obj\nup: ../secret.obj\nabsolute: /etc/passwd\n");
  const std::string yaml = (folder / "data/object.yaml").string();
  YamlMapReader reader(parseYamlFile(yaml), yaml, "");
  EXPECT_EQ(reader.file("own"), (folder / "data/own.obj").string());
  for (const auto& [key, line] : {std::pair("up", 2), std::pair("absolute", 3)}) {
    const std::string said = complaint([&, key = key] { reader.file(key); });
    EXPECT_TRUE(says(said, yaml + ":" + std::to_string(line) + ": " + key));
    EXPECT_TRUE(says(said, "--allow-outside"));
    EXPECT_NE(reader.file(key, FileScope::kAnywhere), "");
  }
}

TEST(ParseYamlFile, RefusesWhatWouldExhaustStackOrMemory) {
  const ScratchFolder folder;
  const std::string yaml = (folder / "deep.yaml").string();
  for (const std::string& text : {std::string(100000, '['), "a: " + std::string(100000, '{')}) {
    replaceFile(yaml, text);
    EXPECT_TRUE(says(complaint([&] { parseYamlFile(yaml); }), "deep.yaml:1: not YAML"));
  }
  std::string blocks;
  for (int depth = 0; depth < 1000; ++depth) blocks += "- ";
  replaceFile(yaml, blocks);
  EXPECT_TRUE(says(complaint([&] { parseYamlFile(yaml); }), "deep.yaml:1: not YAML"));
  replaceFile(yaml, std::string(2 << 20, '#'));
  EXPECT_TRUE(says(complaint([&] { parseYamlFile(yaml); }), "a YAML file may have up to"));
}

}  // namespace
}  // namespace softbody
