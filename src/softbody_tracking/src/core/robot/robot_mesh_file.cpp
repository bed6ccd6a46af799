#include "robot/robot_mesh_file.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <assimp/Importer.hpp>
#include <filesystem>
#include <stdexcept>

#include "robot/solids.h"

namespace softbody {
namespace {

Eigen::RowVector3d toRow(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

TriangleMesh meshOf(const aiMesh& mesh, const aiMatrix4x4& transform) {
  TriangleMesh result{Points(mesh.mNumVertices, 3), Triangles(mesh.mNumFaces, 3)};
  for (unsigned k = 0; k < mesh.mNumVertices; ++k)
    result.vertices.row(k) = toRow(transform * mesh.mVertices[k]);
  int triangle = 0;
  for (unsigned k = 0; k < mesh.mNumFaces; ++k) {
    const aiFace& face = mesh.mFaces[k];
    if (face.mNumIndices != 3) continue;  // points and lines
    for (int corner = 0; corner < 3; ++corner)
      result.triangles(triangle, corner) = static_cast<int>(face.mIndices[corner]);
    ++triangle;
  }
  result.triangles.conservativeResize(triangle, 3);
  return result;
}

void addNode(const aiScene& scene, const aiNode& node, const aiMatrix4x4& parent, TriangleMesh* whole) {
  const aiMatrix4x4 transform = parent * node.mTransformation;
  for (unsigned k = 0; k < node.mNumMeshes; ++k)
    append(meshOf(*scene.mMeshes[node.mMeshes[k]], transform), whole);
  for (unsigned k = 0; k < node.mNumChildren; ++k) addNode(scene, *node.mChildren[k], transform, whole);
}

}  // namespace

std::string robotFilePath(const std::string& name, const PackageFolder& packages, const std::string& folder) {
  const std::size_t scheme_end = name.find("://");
  if (scheme_end == std::string::npos) return (std::filesystem::path(folder) / name).string();
  const std::string scheme = name.substr(0, scheme_end), rest = name.substr(scheme_end + 3);
  if (scheme == "file") return rest;
  if (scheme != "package")
    throw std::invalid_argument(
        fmt::format("{}: '{}://' cannot be read; use package:// or file://", name, scheme));
  const std::string package = rest.substr(0, rest.find('/'));
  const std::string place = packages(package);
  if (place.empty())
    throw std::invalid_argument(fmt::format(
        "{}: package {} is not found; install it, or source the setup.bash of its workspace", name, package));
  return place + rest.substr(package.size());
}

TriangleMesh readRobotMesh(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored))
    throw std::invalid_argument(path + ": there is no such file");
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = importer.ReadFile(
      path, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices | aiProcess_DropNormals);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw std::invalid_argument(fmt::format("{}: {}", path, importer.GetErrorString()));
  TriangleMesh mesh;
  addNode(*scene, *scene->mRootNode, aiMatrix4x4(), &mesh);
  if (mesh.triangles.rows() == 0) throw std::invalid_argument(path + ": it has no triangles");
  if (!mesh.vertices.allFinite()) throw std::invalid_argument(path + ": a vertex is not finite");
  return mesh;
}

}  // namespace softbody
