#include "bodies/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

namespace softbody::virtual_camera {
namespace {

namespace fs = std::filesystem;

/// A line of an OBJ or MTL file: its keyword, and the rest, a name that can contain blanks.
struct Line {
  std::string keyword, rest;
  std::string place;  ///< file and line, for messages
};

template <typename Visit>
void visitLines(const fs::path& path, const Visit& visit) {
  std::ifstream file(path);
  int number = 0;
  for (std::string text; std::getline(file, text);) {
    Line line;
    line.place = fmt::format("{}:{}", path.string(), ++number);
    std::istringstream words(text.substr(0, text.find('#')));
    words >> line.keyword >> std::ws;
    std::getline(words, line.rest);
    line.rest.erase(line.rest.find_last_not_of(" \t\r") + 1);
    visit(line);
  }
}

/// The path of a file that another file refers to. @throw std::invalid_argument if it is missing or outside.
fs::path namedFile(const Line& line, const fs::path& folder, FileScope scope) {
  fs::path path = folder / line.rest;
  if (scope == FileScope::kOwnFolder && !isInside(path, folder)) {
    throw std::invalid_argument(fmt::format("{}: {} names '{}': {}", line.place, line.keyword, line.rest,
                                            outsideSentence(path, folder)));
  }
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown)) {
    throw std::invalid_argument(fmt::format("{}: {} names '{}', but there is no file {}", line.place,
                                            line.keyword, line.rest, path.string()));
  }
  return path;
}

class MaterialReader {
 public:
  MaterialReader(const fs::path& obj_path, FileScope scope) : scope_(scope) {
    visitLines(obj_path, [&](const Line& line) {
      if (line.keyword == "mtllib") readLibrary(namedFile(line, obj_path.parent_path(), scope_));
      if (line.keyword == "usemtl") use(line);
      if (line.keyword == "f") addFace(line);
    });
  }

  ObjMaterials result;

 private:
  void readLibrary(const fs::path& path) {
    std::string material;
    visitLines(path, [&](const Line& line) {
      if (line.keyword == "newmtl") images_[material = line.rest] = -1;
      if (line.keyword == "map_Kd") images_[material] = imageIndex(line, path.parent_path());
    });
  }

  int imageIndex(const Line& line, const fs::path& folder) {
    if (line.rest.compare(0, 1, "-") == 0) {
      throw std::invalid_argument(
          fmt::format("{}: options of map_Kd ('{}') are not supported", line.place, line.rest));
    }
    const std::string file = namedFile(line, folder, scope_).string();
    const auto found = std::find(result.files.begin(), result.files.end(), file);
    if (found == result.files.end())
      return result.files.push_back(file), static_cast<int>(result.files.size()) - 1;
    return static_cast<int>(found - result.files.begin());
  }

  void use(const Line& line) {
    const auto found = images_.find(line.rest);
    if (found == images_.end()) {
      throw std::invalid_argument(
          fmt::format("{}: the material '{}' is not in the mtllib files above", line.place, line.rest));
    }
    current_ = found->second;
  }

  void addFace(const Line& line) {
    std::istringstream words(line.rest);
    int corners = 0;
    for (std::string corner; words >> corner;) ++corners;
    result.image.insert(result.image.end(), static_cast<std::size_t>(std::max(0, corners - 2)), current_);
  }

  FileScope scope_;
  std::map<std::string, int> images_;  ///< by material
  int current_ = -1;
};

}  // namespace

ObjMaterials readObjMaterials(const std::string& obj_path, FileScope scope) {
  return MaterialReader(obj_path, scope).result;
}

}  // namespace softbody::virtual_camera
