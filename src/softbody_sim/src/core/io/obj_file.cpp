#include "io/obj_file.h"

#include <fmt/format.h>

#include <charconv>
#include <set>

#include "io/polygon_soup.h"
#include "softbody_common/files/text_reader.h"

namespace softbody {
namespace {

constexpr std::size_t kMostNamed = 3;  // ignored keywords in a warning; a file of another kind has thousands

class ObjReader {
 public:
  explicit ObjReader(const std::string& path) : reader_(path) {}

  SurfaceFile read(Warnings* warnings) {
    while (reader_.next()) readLine();
    SurfaceFile file = triangulated(soup_, reader_.path(), ":", warnings);
    file.materials = std::move(materials_);
    file.references = std::move(libraries_);
    if (!ignored_.empty()) warnings->push_back(ignoredSentence());
    return file;
  }

 private:
  void readLine() {
    static const std::set<std::string> kDecoration{"vn", "vp", "o", "g", "s"};
    const std::string keyword = reader_.keyword();
    if (keyword == "v") {
      soup_.addVertex(reader_, 1);
    } else if (keyword == "vt") {
      const bool is_line = reader_.fields().size() == 2;
      soup_.texture.emplace_back(parseNumber(reader_.field(1)), is_line ? 0.0 : parseNumber(reader_.field(2)),
                                 0.0);
    } else if (keyword == "f") {
      readFace();
    } else if (keyword == "usemtl") {
      useMaterial(std::string(reader_.rest()));
    } else if (keyword == "mtllib") {
      libraries_.push_back({reader_.path(), reader_.line(), keyword, std::string(reader_.rest())});
    } else if (kDecoration.count(keyword) == 0) {
      ignored_.emplace(reader_.fields().front());
    }
  }

  void readFace() {
    std::vector<Corner> corners;
    for (std::size_t k = 1; k < reader_.fields().size(); ++k)
      corners.push_back(readCorner(reader_.fields()[k]));
    soup_.addFace(corners, material_, reader_.line());
  }

  /// "v", "v/vt", "v//vn" or "v/vt/vn".
  Corner readCorner(std::string_view text) const {
    const std::size_t slash = text.find('/');
    Corner corner;
    corner.vertex = index(text.substr(0, slash), soup_.vertices.size(), text);
    if (slash == std::string_view::npos) return corner;
    const std::string_view rest = text.substr(slash + 1);
    const std::string_view texture = rest.substr(0, rest.find('/'));
    if (!texture.empty()) corner.texture = index(texture, soup_.texture.size(), text);
    return corner;
  }

  /// 1 is the first entry; -1 is the last entry read so far.
  int index(std::string_view digits, std::size_t so_far, std::string_view corner) const {
    int value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) {
      reader_.fail(fmt::format("'{}' is not a face corner", corner));
    }
    const long long zero_based = value > 0 ? value - 1LL : static_cast<long long>(so_far) + value;
    if (value == 0 || zero_based < 0) reader_.fail(fmt::format("face corner '{}' is out of range", corner));
    return static_cast<int>(zero_based);
  }

  void useMaterial(const std::string& name) {
    const auto [entry, is_new] = material_index_.try_emplace(name, static_cast<int>(materials_.size()));
    if (is_new) materials_.push_back(name);
    material_ = entry->second;
  }

  std::string ignoredSentence() const {
    std::string named;
    std::size_t count = 0;
    for (auto keyword = ignored_.begin(); keyword != ignored_.end() && count < kMostNamed; ++keyword, ++count)
      named += (count > 0 ? ", '" : "'") + *keyword + "'";
    const char* others = ignored_.size() > kMostNamed ? " and others" : "";
    return fmt::format("{}: {} lines{} were ignored", reader_.path(), named, others);
  }

  TextReader reader_;
  PolygonSoup soup_;
  std::vector<FileReference> libraries_;
  std::map<std::string, int> material_index_;
  std::vector<std::string> materials_;
  int material_ = -1;
  std::set<std::string> ignored_;
};

}  // namespace

SurfaceFile readObj(const std::string& path, Warnings* warnings) { return ObjReader(path).read(warnings); }

}  // namespace softbody
