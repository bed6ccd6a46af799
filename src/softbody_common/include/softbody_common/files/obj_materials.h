#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace softbody {

/// A line that names another file, e.g. "mtllib body.mtl".
struct FileReference {
  std::filesystem::path file;  ///< that has the line
  int line = 0;
  std::string keyword, name;  ///< a name may contain blanks
};

/// The lines "keyword name" of an OBJ or MTL file. Capitals do not matter. @throw std::invalid_argument as
/// readTextFile.
std::vector<FileReference> fileReferences(const std::filesystem::path& file,
                                          const std::vector<std::string>& keywords);

/// The pictures of a mesh file.
struct MaterialPictures {
  std::vector<std::string> files;  ///< existing files, each once
  std::vector<int> index;          ///< per material, into `files`; -1: no picture
  int otherwise = -1;  ///< of faces without a material: the first picture if no materials were asked for
};

/// The pictures of materials. A file is searched under its name, in which '\' may stand for '/'. If it is not
/// there, the last part of the name is searched beside the file that names it. Options of map_Kd are ignored
/// with a warning. A file that is missing, unreadable or outside of the folder `within` (empty: any place)
/// gives a warning. @param references mtllib lines, whose files name a picture (map_Kd) for each material; or
/// one line for each of the materials that names its picture.
MaterialPictures picturesOf(const std::vector<FileReference>& references,
                            const std::vector<std::string>& materials, const std::filesystem::path& within,
                            std::vector<std::string>* warnings);

}  // namespace softbody
