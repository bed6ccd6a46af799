#include "object/mesh_cache.h"

#include <fmt/format.h>
#include <unistd.h>

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>

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
  throw std::runtime_error("neither XDG_CACHE_HOME nor HOME is set");
}

/// The cache file of a mesh; nothing, with a warning, if there is no usable cache.
std::optional<fs::path> cacheFile(const std::string& name, Warnings* warnings) {
  try {
    const fs::path folder = cacheFolder();
    fs::create_directories(folder);
    return folder / (name + ".vtu");
  } catch (const std::runtime_error& error) {
    warnings->push_back(fmt::format("there is no model cache: {}", error.what()));
    return std::nullopt;
  }
}

std::optional<TetMesh> readCached(const fs::path& file, Warnings* warnings) {
  if (!fs::exists(file)) return std::nullopt;
  try {
    Warnings ignored;
    return readTetFile(file.string(), &ignored);
  } catch (const std::invalid_argument& error) {
    warnings->push_back(fmt::format("a cached mesh is damaged and is made again: {}", error.what()));
    return std::nullopt;
  }
}

/// Written under another name and renamed, so that no reader sees an incomplete file.
void writeCached(const fs::path& file, const TetMesh& mesh, Warnings* warnings) {
  const fs::path temporary = fmt::format("{}.{}", file.string(), getpid());
  try {
    writeVtu(temporary.string(), mesh);
    fs::rename(temporary, file);
  } catch (const std::runtime_error& error) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    warnings->push_back(fmt::format("the prepared model is not cached: {}", error.what()));
  }
}

}  // namespace

std::string contentName(const std::string& content) {
  return to_string(boost::uuids::name_generator_sha1(boost::uuids::ns::oid())(content));
}

TetMesh cachedTetMesh(const std::string& name, const std::function<TetMesh()>& make, Warnings* warnings) {
  const std::optional<fs::path> file = cacheFile(name, warnings);
  if (file) {
    if (std::optional<TetMesh> cached = readCached(*file, warnings)) return *cached;
  }
  TetMesh made = make();
  if (file) writeCached(*file, made, warnings);
  return made;
}

}  // namespace softbody
