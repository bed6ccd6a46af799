#include "object/mesh_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "io/vtu_file.h"
#include "softbody_common/files/input_file.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_sim/io/tet_files.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

/// @throw std::runtime_error if no environment variable names a folder.
fs::path cacheFolder() {
  const char* cache_home = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  if (cache_home != nullptr && *cache_home != '\0') return fs::path(cache_home) / "softbody";
  if (home != nullptr && *home != '\0') return fs::path(home) / ".cache" / "softbody";
  throw std::runtime_error("neither XDG_CACHE_HOME nor HOME is set; set one of them to a folder");
}

/// The last line of an entry: what it was made from, and the hash of the lines above. XML readers skip it.
std::string seal(const std::string& name, const std::string& text) {
  return fmt::format("<!-- inputs {} content {} -->\n", name, contentName(text));
}

/// The mesh of an entry; nothing if there is no entry. @throw std::exception if the entry cannot be used.
std::optional<TetMesh> readEntry(const fs::path& file, const std::string& name) {
  if (!fs::exists(fs::symlink_status(file))) return std::nullopt;
  const std::string entry = readFile(file);
  const std::size_t length = seal(name, "").size();
  const std::string text = entry.substr(0, entry.size() - std::min(entry.size(), length));
  if (entry != text + seal(name, text))
    throw std::invalid_argument(file.string() + ": it was changed, or made from other inputs");
  Warnings ignored;
  return parseVtu(file.string(), text, &ignored);
}

void writeEntry(const fs::path& file, const std::string& name, const TetMesh& mesh) {
  fs::create_directories(file.parent_path());
  const std::string text = vtuText(mesh);
  replaceFile(file, text + seal(name, text));
}

}  // namespace

std::string contentName(const std::string& content) {
  return to_string(boost::uuids::name_generator_sha1(boost::uuids::ns::oid())(content));
}

TetMesh cachedTetMesh(const std::string& name, const std::function<TetMesh()>& make, Warnings* warnings) {
  std::string trouble;
  fs::path file;
  try {
    file = cacheFolder() / (name + ".vtu");
    if (const std::optional<TetMesh> kept = readEntry(file, name)) return *kept;
  } catch (const std::exception& error) {
    trouble = error.what();
  }
  TetMesh made = make();
  try {
    if (!file.empty()) writeEntry(file, name, made);
  } catch (const std::exception& error) {
    if (trouble.empty()) trouble = error.what();
  }
  if (!trouble.empty())
    warnings->push_back(
        fmt::format("the cache of prepared models is not used, the model is made: {}", trouble));
  return made;
}

}  // namespace softbody
