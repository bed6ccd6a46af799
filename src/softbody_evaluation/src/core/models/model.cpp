#include "softbody_evaluation/models/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "measures/corner_weights.h"
#include "softbody_common/files/text_reader.h"
#include "softbody_evaluation/measures/statistics.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/object/object_description.h"
#include "softbody_sim/surface_mesh/closest_point.h"

namespace softbody::evaluation {
namespace {

void readPictures(const SurfaceFile& file, FileScope scope, Model* model,
                  std::vector<std::string>* warnings) {
  const SurfacePictures pictures = surfacePictures(file, scope, warnings);
  if (pictures.files.empty() || file.texture_coordinates.rows() == 0) return;
  model->picture = pictures.picture;
  for (const std::string& path : pictures.files) {
    model->pictures.push_back(cv::imread(path, cv::IMREAD_COLOR));
    if (model->pictures.back().empty())
      throw std::invalid_argument(fmt::format("{}: is not an image that OpenCV can read", path));
  }
}

Model readMesh(const std::string& path, double unit_m, FileScope scope, std::vector<std::string>* warnings) {
  SurfaceFile file = readSurfaceFile(path, warnings);
  Model model;
  model.name = path;
  readPictures(file, scope, &model, warnings);
  model.mesh = {unit_m * file.mesh.vertices, std::move(file.mesh.triangles)};
  model.texture_coordinates = std::move(file.texture_coordinates);
  model.seen = std::move(file.seen);
  return model;
}

/// The visual mesh may have other vertices than the scan: each takes the value of the nearest place.
std::vector<float> seenOf(const TriangleMesh& mesh, const SurfaceFile& scan) {
  const ClosestPointQuery query(scan.mesh.vertices, scan.mesh.triangles);
  std::vector<float> seen;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const SurfacePoint nearest = query.closest(mesh.vertices.row(v));
    const auto corners = scan.mesh.triangles.row(nearest.triangle);
    const Eigen::Vector3d weights =
        cornerWeights(scan.mesh.vertices, {corners[0], corners[1], corners[2]}, nearest.position);
    double value = 0.0;
    for (int k = 0; k < 3; ++k) value += weights[k] * scan.seen[static_cast<std::size_t>(corners[k])];
    seen.push_back(static_cast<float>(value));
  }
  return seen;
}

Model readObject(const std::string& path, std::vector<std::string>* warnings) {
  const ObjectDescription object = loadObjectDescription(path);
  Model model = readMesh(object.visual_mesh, object.unit_m, FileScope::kOwnFolder, warnings);
  const std::filesystem::path scan = std::filesystem::path(path) / "scan.ply";
  if (!std::filesystem::is_regular_file(scan)) return model;
  const SurfaceFile file = readSurfaceFile(scan.string(), warnings);
  if (!file.seen.empty()) model.seen = seenOf(model.mesh, file);
  return model;
}

/// Bilinear, (0, 0) of (u, v) at the lower left corner of the picture.
Eigen::Vector3d pixelAt(const cv::Mat3b& picture, const Eigen::Vector2d& uv) {
  const double x = std::clamp(uv.x() * picture.cols - 0.5, 0.0, picture.cols - 1.0);
  const double y = std::clamp((1.0 - uv.y()) * picture.rows - 0.5, 0.0, picture.rows - 1.0);
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const double fx = x - x0, fy = y - y0;
  Eigen::Vector3d color = Eigen::Vector3d::Zero();
  for (const int i : {0, 1}) {
    for (const int j : {0, 1}) {
      const cv::Vec3b& pixel =
          picture(std::min(y0 + i, picture.rows - 1), std::min(x0 + j, picture.cols - 1));
      color +=
          (i == 1 ? fy : 1.0 - fy) * (j == 1 ? fx : 1.0 - fx) * Eigen::Vector3d(pixel[0], pixel[1], pixel[2]);
    }
  }
  return color;
}

}  // namespace

Model readModel(const std::string& path, std::vector<std::string>* warnings) {
  if (!std::filesystem::exists(path)) throw std::invalid_argument(fmt::format("{}: does not exist", path));
  const std::string extension = extensionOf(path);
  const bool is_object = std::filesystem::is_directory(path) || extension == "yaml" || extension == "yml";
  Model model = is_object ? readObject(path, warnings) : readMesh(path, 1.0, FileScope::kOwnFolder, warnings);
  if (!(diagonalOf(model.mesh) > 0.0))
    throw std::invalid_argument(fmt::format("{}: all triangles are in one point", path));
  return model;
}

double diagonalOf(const TriangleMesh& mesh) {
  Eigen::RowVector3d low = mesh.vertices.row(mesh.triangles(0, 0)), high = low;
  for (const int v : mesh.triangles.reshaped()) {
    low = low.cwiseMin(mesh.vertices.row(v));
    high = high.cwiseMax(mesh.vertices.row(v));
  }
  return (high - low).norm();
}

Eigen::Vector3d colorAt(const Model& model, int triangle, const Eigen::Vector3d& weights) {
  const int picture = model.picture.empty() ? -1 : model.picture[static_cast<std::size_t>(triangle)];
  if (picture < 0) return Eigen::Vector3d::Constant(kNothing);
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  for (int k = 0; k < 3; ++k)
    uv += weights[k] * model.texture_coordinates.row(3 * triangle + k).head<2>().transpose();
  return pixelAt(model.pictures[static_cast<std::size_t>(picture)], uv);
}

}  // namespace softbody::evaluation
