#include "report/report_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <set>
#include <stdexcept>

#include "softbody_common/files/input_file.h"
#include "softbody_common/files/staged_output.h"

namespace softbody::evaluation {
namespace {

namespace fs = std::filesystem;

constexpr char kDocument[] = "report.json", kPage[] = "report.html";

/// The files of an earlier report, as its report.json lists them. Empty without an earlier report.
std::set<std::string> filesOfReport(const fs::path& folder) {
  if (!fs::is_regular_file(fs::symlink_status(folder / kDocument))) return {};
  const auto document = nlohmann::json::parse(readFile(folder / kDocument), nullptr, false);
  const auto listed = document.is_object() ? document.value("files", nlohmann::json()) : nlohmann::json();
  std::set<std::string> files;
  for (const auto& file : listed) {
    if (file.is_string()) files.insert(file.get<std::string>());
  }
  return files;
}

/// Only a report is replaced, and only if all files in its folder belong to it.
/// @throw std::invalid_argument
void requireReplaceable(const fs::path& folder) {
  const fs::file_status status = fs::symlink_status(folder);
  if (!fs::exists(status)) return;
  if (!fs::is_directory(status))
    throw std::invalid_argument(
        fmt::format("{} is not a folder; choose another one for the report", folder.string()));
  const std::set<std::string> files = filesOfReport(folder);
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (files.count(name) > 0 && fs::is_regular_file(entry.symlink_status())) continue;
    throw std::invalid_argument(fmt::format("{} has {}, which is not part of a report; choose another folder",
                                            folder.string(), name));
  }
}

/// The document, with a list of the report's files.
std::string listing(nlohmann::json document, const Pictures& pictures) {
  std::vector<std::string> files{kDocument, kPage};
  for (const auto& [name, picture] : pictures) {
    if (!picture.empty()) files.push_back(name);
  }
  document["files"] = files;
  return document.dump(2) + "\n";
}

void writePicture(const fs::path& path, const cv::Mat3b& picture) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(path.extension().string(), picture, bytes);
  writeBytes(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

void writeReportFolder(const std::string& folder, const nlohmann::json& document, const std::string& page,
                       const Pictures& pictures) {
  const fs::path absolute = fs::absolute(folder).lexically_normal();
  const fs::path target = absolute.has_filename() ? absolute : absolute.parent_path();
  requireReplaceable(target);
  StagedFolder report(target);
  writeBytes(report.path() / kDocument, listing(document, pictures));
  writeBytes(report.path() / kPage, page);
  for (const auto& [name, picture] : pictures) {
    if (!picture.empty()) writePicture(report.path() / name, picture);
  }
  report.replaceTarget();
}

}  // namespace softbody::evaluation
