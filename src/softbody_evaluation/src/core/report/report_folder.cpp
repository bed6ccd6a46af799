#include "softbody_evaluation/report/report_folder.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

namespace softbody::evaluation {
namespace {

namespace fs = std::filesystem;

/// Only a report is replaced, never another folder of the user, even if it has only pictures.
/// @throw std::invalid_argument
void requireReplaceable(const fs::path& folder) {
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder))
    throw std::invalid_argument(fmt::format("{} is not a folder", folder.string()));
  const bool is_report = fs::exists(folder / "report.json");
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path& file = entry.path();
    const bool ours =
        file.extension() == ".png" || file.filename() == "report.json" || file.filename() == "report.html";
    if (!is_report || !ours || !entry.is_regular_file()) {
      throw std::invalid_argument(
          fmt::format("{} has {}, which is not part of a report; choose another folder", folder.string(),
                      file.filename().string()));
    }
  }
}

void writeText(const fs::path& path, const std::string& text) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::invalid_argument(fmt::format("{}: cannot be written", path.string()));
}

void writeAll(const fs::path& folder, const nlohmann::json& document, const std::string& page,
              const Pictures& pictures) {
  writeText(folder / "report.json", document.dump(2) + "\n");
  writeText(folder / "report.html", page);
  for (const auto& [name, picture] : pictures) {
    if (!picture.empty() && !cv::imwrite((folder / name).string(), picture))
      throw std::invalid_argument(fmt::format("{}: cannot be written", (folder / name).string()));
  }
}

}  // namespace

void writeReportFolder(const std::string& folder, const nlohmann::json& document, const std::string& page,
                       const Pictures& pictures) {
  // Without the trailing slash of "report/", so that "report.part" is beside the folder.
  const std::string absolute = fs::absolute(folder).lexically_normal().string();
  const fs::path target = absolute.back() == '/' ? absolute.substr(0, absolute.size() - 1) : absolute;
  requireReplaceable(target);
  const fs::path fresh = target.string() + ".part", earlier = target.string() + ".old";
  fs::remove_all(fresh);
  fs::create_directories(fresh);
  try {
    writeAll(fresh, document, page, pictures);
  } catch (...) {
    fs::remove_all(fresh);
    throw;
  }
  fs::remove_all(earlier);
  if (fs::exists(target)) fs::rename(target, earlier);
  fs::rename(fresh, target);
  fs::remove_all(earlier);
}

}  // namespace softbody::evaluation
