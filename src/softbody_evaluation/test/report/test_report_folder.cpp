#include "softbody_evaluation/report/report_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "softbody_evaluation/report/html_page.h"

namespace softbody::evaluation {
namespace {

namespace fs = std::filesystem;

TEST(ReportFolder, ThePageHoldsItsPicturesAndReplacesAnEarlierReportAsAWhole) {
  const std::string folder = testing::TempDir() + "report_folder_test";
  fs::remove_all(folder);
  const Pictures pictures{{"a.png", cv::Mat3b(4, 4, cv::Vec3b(1, 2, 3))}};
  const std::string page = htmlPage("a <b>", {{"error", "mm", 1.5, {}}}, "x < y & z", pictures);
  EXPECT_NE(page.find("src=\"data:image/png;base64,iVBORw0KGgo"), std::string::npos);
  EXPECT_NE(page.find("a &lt;b&gt;"), std::string::npos);
  EXPECT_NE(page.find("x &lt; y &amp; z"), std::string::npos);
  EXPECT_EQ(page.find("src=\"a.png"), std::string::npos);
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
      htmlPage("t", {}, "",
               {{"a.png", picture}, {"b.png", picture}, {"other_a.png", picture}, {"other_c.png", picture}});
  std::vector<std::string> order;
  const std::string mark = "<figcaption>";
  for (std::size_t at = page.find(mark); at != std::string::npos; at = page.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    order.push_back(page.substr(begin, page.find('<', begin) - begin));
  }
  EXPECT_EQ(order, (std::vector<std::string>{"a.png", "other_a.png", "b.png", "other_c.png"}));
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
