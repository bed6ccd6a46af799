#include "identification/estimate_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "softbody_common/files/input_file.h"
#include "softbody_common/files/object_path.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_sim/identification/fit_picture.h"
#include "softbody_sim/object/material_yaml.h"

namespace softbody {
namespace {

std::filesystem::path folderOf(const std::string& file) {
  return std::filesystem::absolute(file).lexically_normal().parent_path();
}

std::string pngOf(const cv::Mat3b& picture) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", picture, bytes);
  return {bytes.begin(), bytes.end()};
}

bool isAsked(const EstimatedProperty& property) { return property.name != "mass"; }

}  // namespace

void requireUsable(const EstimateOutput& output) {
  if (output.yaml.empty()) return;
  const std::filesystem::path from = folderOf(objectYamlAt(output.object)), to = folderOf(output.yaml);
  std::error_code error;
  if (std::filesystem::equivalent(from, to, error)) return;
  throw std::invalid_argument(
      fmt::format("--output {} is not in the folder of the object, whose files it names; write it to {}",
                  output.yaml, (from / std::filesystem::path(output.yaml).filename()).string()));
}

bool isComplete(const MaterialEstimate& estimate) {
  return std::all_of(estimate.properties.begin(), estimate.properties.end(),
                     [](const EstimatedProperty& p) { return p.observable || !isAsked(p); });
}

std::string write(const EstimateOutput& output, const MaterialProblem& problem,
                  const MaterialEstimate& estimate, const std::string& report) {
  std::string written;
  if (!output.folder.empty()) {
    const std::filesystem::path folder(output.folder);
    std::filesystem::create_directories(folder);
    replaceFile(folder / "report.txt", report);
    replaceFile(folder / "fit.png", pngOf(drawFit(problem, estimate)));
    written += fmt::format("wrote {0}/report.txt and {0}/fit.png\n", output.folder);
  }
  const bool any = std::any_of(estimate.properties.begin(), estimate.properties.end(),
                               [](const EstimatedProperty& p) { return p.observable && isAsked(p); });
  if (output.yaml.empty()) return written;
  if (!any) return written + fmt::format("{} was not written: nothing was found\n", output.yaml);
  const std::string object = objectYamlAt(output.object);
  replaceFile(output.yaml, withMaterial(readTextFile(object), estimate.material, object));
  return written + fmt::format("wrote {}\n", output.yaml);
}

}  // namespace softbody
