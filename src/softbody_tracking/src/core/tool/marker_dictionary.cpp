#include "tool/marker_dictionary.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <stdexcept>

#include "softbody_tracking/tool/marker_detector.h"

namespace softbody {
namespace {

const std::map<std::string, int>& predefined() {
  using namespace cv::aruco;
  static const std::map<std::string, int> kNames{{"DICT_4X4_50", DICT_4X4_50},
                                                 {"DICT_4X4_100", DICT_4X4_100},
                                                 {"DICT_4X4_250", DICT_4X4_250},
                                                 {"DICT_4X4_1000", DICT_4X4_1000},
                                                 {"DICT_5X5_50", DICT_5X5_50},
                                                 {"DICT_5X5_100", DICT_5X5_100},
                                                 {"DICT_5X5_250", DICT_5X5_250},
                                                 {"DICT_5X5_1000", DICT_5X5_1000},
                                                 {"DICT_6X6_50", DICT_6X6_50},
                                                 {"DICT_6X6_100", DICT_6X6_100},
                                                 {"DICT_6X6_250", DICT_6X6_250},
                                                 {"DICT_6X6_1000", DICT_6X6_1000},
                                                 {"DICT_7X7_50", DICT_7X7_50},
                                                 {"DICT_7X7_100", DICT_7X7_100},
                                                 {"DICT_7X7_250", DICT_7X7_250},
                                                 {"DICT_7X7_1000", DICT_7X7_1000},
                                                 {"DICT_ARUCO_ORIGINAL", DICT_ARUCO_ORIGINAL},
                                                 {"DICT_APRILTAG_16h5", DICT_APRILTAG_16h5},
                                                 {"DICT_APRILTAG_25h9", DICT_APRILTAG_25h9},
                                                 {"DICT_APRILTAG_36h10", DICT_APRILTAG_36h10},
                                                 {"DICT_APRILTAG_36h11", DICT_APRILTAG_36h11}};
  return kNames;
}

/// A family's published marker 0: its bits row by row from the top left, the first one most significant,
/// 1 white.
struct PublishedMarker {
  const char* prefix;  ///< of the dictionary's name
  std::uint64_t bits;
};
constexpr PublishedMarker kPublished[] = {
    // by their authors; see docs/pipeline/tool_tracking.md
    {"DICT_4X4_", 0xb532},
    {"DICT_5X5_", 0x145b2bc},
    {"DICT_6X6_", 0x1e3dd82a6},
    {"DICT_7X7_", 0x1bab8d94b9415},
    {"DICT_ARUCO_ORIGINAL", 0x1084210},
    {"DICT_APRILTAG_16h5", 0x231b},
    {"DICT_APRILTAG_25h9", 0x155cbf1},
    {"DICT_APRILTAG_36h10", 0x1ca92a687},
    {"DICT_APRILTAG_36h11", 0xd5d628584},
};

std::uint64_t packed(const cv::Mat1b& bits) {
  std::uint64_t code = 0;
  for (int i = 0; i < bits.rows * bits.cols; ++i) code = 2 * code + bits(i / bits.cols, i % bits.cols);
  return code;
}

/// @param quarter_turns clockwise.
cv::Mat1b turned(const cv::Mat1b& bits, int quarter_turns) {
  cv::Mat1b result = bits;
  if (quarter_turns > 0) cv::rotate(bits, result, quarter_turns - 1);  // ROTATE_90_CLOCKWISE = 0, ...
  return result;
}

cv::Mat1b bitsOf(const aruco::Dictionary& dictionary, int id) {
  return aruco::Dictionary::getBitsFromByteList(dictionary.bytesList.rowRange(id, id + 1),
                                                dictionary.markerSize);
}

/// Quarter turns clockwise that make OpenCV's markers the published ones.
int turnsToPublished(const std::string& name, const aruco::Dictionary& dictionary) {
  for (const PublishedMarker& published : kPublished) {
    if (name.rfind(published.prefix, 0) != 0) continue;
    for (int turns = 0; turns < 4; ++turns) {
      if (packed(turned(bitsOf(dictionary, 0), turns)) == published.bits) return turns;
    }
  }
  throw std::runtime_error(fmt::format(
      "marker 0 of {} in OpenCV {} is not the published one, so poses would be wrong: use another version of "
      "OpenCV, or another dictionary",
      name, CV_VERSION));
}

aruco::Dictionary turned(const aruco::Dictionary& dictionary, int quarter_turns) {
  aruco::Dictionary result = dictionary;
  result.bytesList = dictionary.bytesList.clone();
  for (int id = 0; id < result.bytesList.rows; ++id) {
    const cv::Mat1b bits = turned(bitsOf(dictionary, id), quarter_turns);
    aruco::Dictionary::getByteListFromBits(bits).copyTo(result.bytesList.rowRange(id, id + 1));
  }
  return result;
}

aruco::Dictionary readDictionaryFile(const std::string& path) try {
  const cv::FileStorage file(path, cv::FileStorage::READ);
  aruco::Dictionary dictionary;
  if (!dictionary.readDictionary(file.root()) || dictionary.bytesList.empty())
    throw std::invalid_argument(path +
                                " is not a marker dictionary: nmarkers, markersize or marker_0 is missing");
  return dictionary;
} catch (const cv::Exception& error) {
  throw std::invalid_argument(fmt::format("{} is not a marker dictionary: {}", path, error.err));
}

}  // namespace

std::vector<std::string> dictionaryNames() {
  std::vector<std::string> names;
  for (const auto& [name, number] : predefined()) names.push_back(name);
  return names;
}

aruco::Dictionary uprightDictionary(const std::string& name) {
  const auto found = predefined().find(name);
  if (found != predefined().end()) {
    const aruco::Dictionary dictionary = aruco::predefinedDictionary(found->second);
    const int turns = turnsToPublished(name, dictionary);
    return turns == 0 ? dictionary : turned(dictionary, turns);
  }
  if (std::filesystem::is_regular_file(name)) return readDictionaryFile(name);
  throw std::invalid_argument(fmt::format("the marker dictionary '{}' is unknown; known: {}, or a file", name,
                                          fmt::join(dictionaryNames(), ", ")));
}

void requireCornerOrder(const std::string& name, const aruco::Dictionary& dictionary,
                        const aruco::Detector& detector) {
  if (predefined().count(name) == 0) return;
  // Pixels of a cell, and of the white margin: enough for every detector.
  constexpr int kCell_px = 8, kMargin_px = 2 * kCell_px;
  const int side_px = kCell_px * (dictionary.markerSize + 2);
  cv::Mat1b image(cv::Size(side_px + 2 * kMargin_px, side_px + 2 * kMargin_px), 255);
  aruco::markerImage(dictionary, 0, side_px)
      .copyTo(image(cv::Rect(kMargin_px, kMargin_px, side_px, side_px)));
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  detector.detect(image, &corners, &ids);
  const auto low = static_cast<float>(kMargin_px), high = static_cast<float>(kMargin_px + side_px);
  const cv::Point2f drawn[] = {{low, low}, {high, low}, {high, high}, {low, high}};
  bool same = corners.size() == 1 && ids[0] == 0;
  for (std::size_t k = 0; k < 4 && same; ++k) same = cv::norm(corners[0][k] - drawn[k]) < kCell_px;
  if (same) return;
  throw std::runtime_error(
      fmt::format("OpenCV {} does not give a drawn marker's corners clockwise from its top left, so poses "
                  "would be wrong: use another version of OpenCV",
                  CV_VERSION));
}

}  // namespace softbody
