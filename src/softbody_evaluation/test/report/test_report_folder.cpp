#include "report/report_folder.h"

#include <test_support/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "report/html_page.h"

namespace softbody::evaluation {
namespace {

namespace fs = std::filesystem;

TEST(ReportFolder, ThePageHoldsItsPicturesAndReplacesAnEarlierReportAsAWhole) {
  const std::string folder = testing::TempDir() + "report_folder_test";
  fs::remove_all(folder);
  const Pictures pictures{{"a.png", cv::Mat3b(4, 4, cv::Vec3b(1, 2, 3))}};
  const std::string page = htmlPage({{"a <b>", {}, {}}}, {{"error", "mm", 1.5, {}}}, "x < y & z", pictures);
  EXPECT_TRUE(says(page, "src=\"data:image/png;base64,iVBORw0KGgo"));
  EXPECT_TRUE(says(page, "a &lt;b&gt;"));
  EXPECT_TRUE(says(page, "x &lt; y &amp; z"));
  EXPECT_FALSE(says(page, "src=\"a.png"));
  writeReportFolder(folder, {{"run", 1}}, page, pictures);
  writeReportFolder(folder + "/", {{"run", 2}}, page, {});
  EXPECT_FALSE(fs::exists(folder + "/a.png"));
  std::ifstream json(folder + "/report.json");
  EXPECT_EQ(nlohmann::json::parse(json)["run"], 2);
}

TEST(ReportFolder, WhatTheUserPutBesideOrIntoAReportStays) {
  const std::string folder = testing::TempDir() + "report_folder_neighbours";
  const auto clear = [&] {
    for (const char* end : {"", ".old", ".part", ".link"}) fs::remove_all(folder + end);
  };
  clear();
  for (const char* end : {".old", ".part"}) {
    fs::create_directories(folder + end);
    std::ofstream(folder + end + "/thesis.tex") << "years of work";
  }
  const Pictures pictures{{"a.png", cv::Mat3b(4, 4)}};
  writeReportFolder(folder, {{"run", 1}}, "", pictures);
  writeReportFolder(folder, {{"run", 2}}, "", pictures);
  for (const char* end : {".old", ".part"}) EXPECT_TRUE(fs::exists(folder + end + "/thesis.tex")) << end;
  fs::create_directory_symlink(folder, folder + ".link");
  EXPECT_THROW(writeReportFolder(folder + ".link", {}, "", {}), std::invalid_argument);
  std::ofstream(folder + "/holiday.png") << "sea";
  EXPECT_THROW(writeReportFolder(folder, {}, "", {}), std::invalid_argument);
  EXPECT_TRUE(fs::exists(folder + "/holiday.png"));
  EXPECT_TRUE(fs::exists(folder + "/a.png"));
  clear();
}

TEST(ReportFolder, TheOtherResultsPictureStandsBesideItsOwn) {
  const cv::Mat3b picture(4, 4, cv::Vec3b(1, 2, 3));
  const std::string page =
      htmlPage({}, {}, "",
               {{"a.png", picture}, {"b.png", picture}, {"other_a.png", picture}, {"other_c.png", picture}});
  std::vector<std::string> order;
  const std::string mark = "<figcaption>";
  for (std::size_t at = page.find(mark); at != std::string::npos; at = page.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    order.push_back(page.substr(begin, page.find('<', begin) - begin));
  }
  EXPECT_EQ(order, (std::vector<std::string>{"a.png", "other_a.png", "b.png", "other_c.png"}));
}

TEST(ReportPage, NeedsNoOtherFileAndNoNetwork) {
  const cv::Mat3b picture(40, 40, cv::Vec3b(1, 2, 3));
  const Film film{{1, "frame 0", picture, picture}, {2, "frame 1", picture, picture}};
  const Verdict verdict{Level::kWrong, {{Level::kWrong, "far < away"}}, {}};
  const std::string page = htmlPage({{"result", verdict, film}}, {{"depth residual, p95", "mm", 99.0, {}}},
                                    "", {{"a.png", picture}});
  // Everything that a browser would load is in the page, and the page forbids the rest.
  for (const char* attribute : {"src=\"", "href=\"", "url("}) {
    for (std::size_t at = page.find(attribute); at != std::string::npos; at = page.find(attribute, at + 1))
      EXPECT_EQ(page.compare(at + std::string(attribute).size(), 11, "data:image/"), 0)
          << page.substr(at, 60);
  }
  EXPECT_FALSE(says(page, "://"));
  EXPECT_TRUE(says(page, "default-src 'none'"));
  EXPECT_LT(page.find("far &lt; away"), page.find("type=range min=0 max=1"));
  EXPECT_TRUE(says(page, "<td class=wrong>99</td>"));
}

TEST(ReportFolder, AFolderOfTheUsersIsNotReplaced) {
  const std::string folder = testing::TempDir() + "report_folder_of_user";
  fs::create_directories(folder);
  std::ofstream(folder + "/thesis.tex") << "years of work";
  EXPECT_THROW(writeReportFolder(folder, {}, "", {}), std::invalid_argument);
  EXPECT_TRUE(fs::exists(folder + "/thesis.tex"));
}

TEST(ReportFolder, AFolderOfTheUsersPicturesIsNotReplaced) {
  const std::string folder = testing::TempDir() + "report_folder_of_pictures";
  fs::create_directories(folder);
  std::ofstream(folder + "/holiday.png") << "sea";
  EXPECT_THROW(writeReportFolder(folder, {}, "", {}), std::invalid_argument);
  EXPECT_TRUE(fs::exists(folder + "/holiday.png"));
}

}  // namespace
}  // namespace softbody::evaluation
