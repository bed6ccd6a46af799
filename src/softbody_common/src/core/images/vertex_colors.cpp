#include "softbody_common/images/vertex_colors.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "softbody_common/files/object_path.h"
#include "softbody_common/files/ply_reader.h"
#include "softbody_common/files/text_reader.h"
#include "softbody_common/files/yaml_map_reader.h"

namespace softbody {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kColoredFields = 7;  // of an OBJ's vertex: its keyword, three coordinates, three shares

/// Colours of vertices, as long as each has one.
class ColorList {
 public:
  /// @param shares of red, green and blue; not finite: this vertex has none.
  void add(const Eigen::RowVector3d& shares) {
    complete_ = complete_ && shares.allFinite();
    if (!complete_) return;
    auto& color = colors_.emplace_back();
    for (int c = 0; c < 3; ++c)
      color[c] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(shares[c], 0.0, 1.0)));
  }

  VertexColors take() { return complete_ ? std::move(colors_) : VertexColors(); }

 private:
  VertexColors colors_;
  bool complete_ = true;
};

VertexColors readPlyColors(const std::string& path) {
  PlyReader reader(path);
  ColorList colors;
  bool more = reader.next();
  while (more && reader.element() != "vertex") more = reader.next();
  for (; more && reader.element() == "vertex"; more = reader.next())
    colors.add({reader.shareOf({"red", "diffuse_red"}), reader.shareOf({"green", "diffuse_green"}),
                reader.shareOf({"blue", "diffuse_blue"})});
  return colors.take();
}

VertexColors readObjColors(const std::string& path) {
  TextReader reader(path);
  ColorList colors;
  while (reader.next()) {
    if (reader.keyword() != "v") continue;
    Eigen::RowVector3d shares = Eigen::RowVector3d::Constant(parseNumber("nan"));
    if (reader.fields().size() >= kColoredFields) {
      for (int c = 0; c < 3; ++c) shares[c] = parseNumber(reader.fields()[kColoredFields - 3 + c]);
    }
    colors.add(shares);
  }
  return colors.take();
}

/// Sums of the colours of neighbours that have one.
struct Mixture {
  Eigen::Array3i sum = Eigen::Array3i::Zero();
  int count = 0;
};

std::vector<Mixture> mixturesOf(const Triangles& triangles, const VertexColors& colors,
                                const std::vector<bool>& known) {
  std::vector<Mixture> mixtures(colors.size());
  for (Eigen::Index corner = 0; corner < triangles.size(); ++corner) {
    const int f = static_cast<int>(corner / 3), k = static_cast<int>(corner % 3);
    const int vertex = triangles(f, k);
    if (known[vertex]) continue;
    for (const int other : {triangles(f, (k + 1) % 3), triangles(f, (k + 2) % 3)}) {
      if (!known[other]) continue;
      for (int c = 0; c < 3; ++c) mixtures[vertex].sum[c] += colors[other][c];
      ++mixtures[vertex].count;
    }
  }
  return mixtures;
}

/// Gives a colour to vertices beside those that have one. @return whether it found any.
bool spread(const Triangles& triangles, VertexColors* colors, std::vector<bool>* known) {
  const std::vector<Mixture> mixtures = mixturesOf(triangles, *colors, *known);
  bool any = false;
  for (std::size_t v = 0; v < mixtures.size(); ++v) {
    if (mixtures[v].count == 0) continue;
    for (int c = 0; c < 3; ++c)
      (*colors)[v][c] = static_cast<std::uint8_t>(mixtures[v].sum[c] / mixtures[v].count);
    any = (*known)[v] = true;
  }
  return any;
}

}  // namespace

VertexColors readVertexColors(const fs::path& mesh) {
  const std::string extension = extensionOf(mesh.string());
  if (extension == "ply") return readPlyColors(mesh.string());
  if (extension == "obj") return readObjColors(mesh.string());
  return {};
}

VertexColors readObjectColors(const fs::path& given, FileScope scope) {
  const fs::path yaml = objectYamlAt(given.string());
  const YAML::Node root = parseYamlFile(yaml.string());
  YamlMapReader object(root["object"], yaml.string(), "object/");
  return readVertexColors(object.file("visual_mesh", scope));
}

VertexColors colorsOfVertices(const MeshTopology& topology, const VertexColors& of_file) {
  if (of_file.empty()) return {};
  VertexColors colors(topology.vertex_parents.size(), {255, 255, 255});
  std::vector<bool> known(colors.size(), false);
  for (std::size_t v = 0; v < colors.size(); ++v) {
    const int parent = topology.vertex_parents[v];
    if (parent < 0) continue;
    if (parent >= static_cast<int>(of_file.size()))
      throw std::invalid_argument(fmt::format(
          "vertex {} comes from vertex {} of the mesh file, which has only {}; is it another file?", v,
          parent, of_file.size()));
    colors[v] = of_file[parent];
    known[v] = true;
  }
  while (spread(topology.triangles, &colors, &known)) continue;
  return colors;
}

}  // namespace softbody
