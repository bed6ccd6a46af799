#include "softbody_virtual_camera/bodies/body.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/io/surface_files.h"

namespace softbody::virtual_camera {
namespace {

Picture readPicture(const std::string& path) {
  cv::Mat image = cv::imread(path, cv::IMREAD_COLOR);
  if (image.empty())
    throw std::invalid_argument(fmt::format("{}: is not an image that OpenCV can read", path));
  cv::cvtColor(image, image, cv::COLOR_BGR2RGB);
  return makePicture(image);
}

}  // namespace

MeshTopology topologyOf(const Body& body) {
  const auto vertices = static_cast<std::size_t>(body.rest.vertices.rows());
  MeshTopology topology;
  topology.rest_vertices = body.rest.vertices;
  topology.triangles = body.rest.triangles;
  topology.vertex_parents.resize(vertices);
  std::iota(topology.vertex_parents.begin(), topology.vertex_parents.end(), 0);
  topology.triangle_pieces = trianglePieces(body.rest.triangles, static_cast<int>(vertices));
  topology.cut.assign(static_cast<std::size_t>(body.rest.triangles.rows()), false);
  topology.texture_coordinates = body.skin.coordinates;
  return topology;
}

Body readBody(const std::string& path, double unit_m, std::vector<std::string>* warnings, FileScope scope) {
  SurfaceFile file = readSurfaceFile(path, warnings);
  SurfacePictures pictures = surfacePictures(file, scope, warnings);
  Body body;
  body.rest = {unit_m * file.mesh.vertices, std::move(file.mesh.triangles)};
  body.skin.coordinates = std::move(file.texture_coordinates);
  if (pictures.files.empty()) return body;
  if (body.skin.coordinates.rows() == 0) {
    throw std::invalid_argument(
        fmt::format("{}: its materials name images, but it has no texture coordinates", path));
  }
  body.skin.picture = std::move(pictures.picture);
  std::transform(pictures.files.begin(), pictures.files.end(), std::back_inserter(body.skin.pictures),
                 readPicture);
  return body;
}

}  // namespace softbody::virtual_camera
