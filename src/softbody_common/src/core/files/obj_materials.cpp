#include "softbody_common/files/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "softbody_common/files/input_file.h"
#include "softbody_common/files/text_reader.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

struct MaterialPicture {
  std::string material;
  fs::path picture;
};

bool isFile(const fs::path& path) {
  std::error_code unknown;
  return fs::is_regular_file(path, unknown);
}

/// The places where a named file may be, the likeliest first. A path of another computer is of use for its
/// last part.
std::vector<fs::path> placesOf(const FileReference& reference) {
  std::string slashed = reference.name;
  std::replace(slashed.begin(), slashed.end(), '\\', '/');
  const fs::path folder = reference.file.parent_path();
  return {folder / reference.name, folder / slashed, folder / fs::path(slashed).filename()};
}

/// The path of a file that may be used; empty without such a file.
fs::path allowedPlace(const FileReference& reference, const fs::path& within) {
  for (const fs::path& place : placesOf(reference)) {
    if (isFile(place) && (within.empty() || isInside(place, within))) return place;
  }
  return {};
}

bool isArgument(const std::string& word) {
  return word == "on" || word == "off" || word.find_first_not_of("+-.0123456789eE") == std::string::npos;
}

/// The name after options such as "-s 2 2 1", which take numbers, "on", "off", or one other word.
std::string withoutOptions(const std::string& text) {
  static const std::set<std::string> kOptions{"-blendu", "-blendv",  "-bm",  "-boost", "-cc",
                                              "-clamp",  "-imfchan", "-mm",  "-o",     "-s",
                                              "-texres", "-t",       "-type"};
  std::istringstream words(text);
  std::string word;
  words >> word;
  while (kOptions.count(word) > 0) {
    const bool takes_word = word == "-type" || word == "-imfchan";
    words >> word;
    if (takes_word) words >> word;
    while (words && isArgument(word)) words >> word;
    if (!words) return {};
  }
  std::string rest;
  std::getline(words, rest);
  return word + rest;
}

/// The place of a file, or nothing and a warning.
fs::path referredFile(const FileReference& r, const fs::path& within, std::vector<std::string>* warnings) {
  const fs::path found = allowedPlace(r, within);
  if (!found.empty()) return found;
  for (const fs::path& place : placesOf(r)) {
    if (!isFile(place)) continue;
    warnings->push_back(fmt::format("{}:{}: {} names '{}': {}", r.file.string(), r.line, r.keyword, r.name,
                                    outsideSentence(place, within)));
    return {};
  }
  warnings->push_back(fmt::format("{}:{}: {} names '{}', but there is no file {}", r.file.string(), r.line,
                                  r.keyword, r.name, placesOf(r)[1].string()));
  return {};
}

/// Several names, if a name with blanks is no file.
std::vector<FileReference> libraries(const FileReference& mtllib, const fs::path& within) {
  if (mtllib.name.find(' ') == std::string::npos || !allowedPlace(mtllib, within).empty()) return {mtllib};
  std::vector<FileReference> all;
  std::istringstream words(mtllib.name);
  for (std::string word; words >> word;) {
    all.push_back(mtllib);
    all.back().name = word;
  }
  const bool any = std::any_of(
      all.begin(), all.end(), [&](const FileReference& part) { return !allowedPlace(part, within).empty(); });
  return any ? all : std::vector<FileReference>{mtllib};
}

/// None, with a warning, if the file cannot be read.
std::vector<FileReference> linesOf(const fs::path& file, std::vector<std::string>* warnings) try {
  if (file.empty()) return {};
  return fileReferences(file, {"newmtl", "map_Kd"});
} catch (const std::invalid_argument& error) {
  warnings->push_back(error.what());
  return {};
}

fs::path pictureOf(FileReference map_kd, const fs::path& within, std::vector<std::string>* warnings) {
  const std::string options_and_name = std::exchange(map_kd.name, withoutOptions(map_kd.name));
  if (map_kd.name != options_and_name)
    warnings->push_back(fmt::format("{}:{}: options of map_Kd ('{}') are ignored", map_kd.file.string(),
                                    map_kd.line, options_and_name));
  return referredFile(map_kd, within, warnings);
}

/// Adds the materials of the files that an mtllib line names, in their order.
void addMaterials(const FileReference& mtllib, const fs::path& within,
                  std::vector<MaterialPicture>* materials, std::vector<std::string>* warnings) {
  std::map<std::string, fs::path> found;  // a missing picture is reported once
  for (const FileReference& library : libraries(mtllib, within)) {
    for (const FileReference& line : linesOf(referredFile(library, within, warnings), warnings)) {
      if (line.keyword == "newmtl" || materials->empty()) materials->push_back({line.name, {}});
      if (line.keyword == "newmtl") continue;
      const auto [entry, is_new] = found.try_emplace(line.name);
      if (is_new) entry->second = pictureOf(line, within, warnings);
      materials->back().picture = entry->second;
    }
  }
}

}  // namespace

std::vector<FileReference> fileReferences(const fs::path& file, const std::vector<std::string>& keywords) {
  std::vector<FileReference> found;
  TextReader reader(file.string());
  while (reader.next()) {
    for (const std::string& keyword : keywords) {
      if (reader.keyword() == lowerCase(keyword))
        found.push_back({file, reader.line(), keyword, std::string(reader.rest())});
    }
  }
  return found;
}

MaterialPictures picturesOf(const std::vector<FileReference>& references,
                            const std::vector<std::string>& materials, const fs::path& within,
                            std::vector<std::string>* warnings) {
  std::vector<MaterialPicture> known;
  for (std::size_t r = 0; r < references.size(); ++r) {
    if (references[r].keyword == "mtllib") {
      addMaterials(references[r], within, &known, warnings);
    } else {
      known.push_back({materials.at(r), referredFile(references[r], within, warnings)});
    }
  }
  MaterialPictures pictures;
  const auto indexOf = [&pictures](const fs::path& picture) {
    if (picture.empty()) return -1;
    const auto found = std::find(pictures.files.begin(), pictures.files.end(), picture.string());
    const auto index = static_cast<int>(found - pictures.files.begin());
    if (found == pictures.files.end()) pictures.files.push_back(picture.string());
    return index;
  };
  for (const std::string& name : materials) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const MaterialPicture& material) {
      return material.material == name;
    });
    pictures.index.push_back(found == known.end() ? -1 : indexOf(found->picture));
    if (found == known.end() && !known.empty())
      warnings->push_back(fmt::format("{}: the material '{}' is in no mtllib file; it has no picture",
                                      references.front().file.string(), name));
  }
  if (!materials.empty()) return pictures;
  for (const MaterialPicture& material : known) indexOf(material.picture);
  if (!pictures.files.empty()) pictures.otherwise = 0;
  return pictures;
}

}  // namespace softbody
