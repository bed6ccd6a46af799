#include "model_folder.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <stdexcept>

#include "model_quality.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 5> kFiles{"visual.obj", "cage.obj", "tets.vtu", "report.txt",
                                            "object.yaml"};

void writeText(const fs::path& path, const std::string& text) {
  std::ofstream stream(path);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error(path.string() + ": cannot be written");
}

std::string objectYaml(const std::string& mesh, const Material& material) {
  return fmt::format(
      "# Made by prepare_model from {}. The material is a guess (soft foam); set it to yours.\n"
      "object:\n  visual_mesh: visual.obj\n  cage_mesh: cage.obj\n  tet_mesh: tets.vtu\n"
      "  material: {{youngs_modulus_pa: {}, poisson_ratio: {}, density_kg_m3: {}, damping: {}}}\n"
      "  # initial_pose: [x, y, z, qx, qy, qz, qw]   # in the colour optical frame, roughly; without it "
      "nothing is tracked\n",
      fs::path(mesh).filename().string(), material.youngs_modulus_pa, material.poisson_ratio,
      material.density_kg_m3, material.damping);
}

std::string report(const std::string& mesh, const ObjectModel& model, const TriangleMesh& cage) {
  const Points& rest = model.visual.rest_vertices;
  const Eigen::RowVector3d extent = 1e3 * (rest.colwise().maxCoeff() - rest.colwise().minCoeff());
  const Eigen::VectorXd volumes = tetVolumes(model.volume.rest_vertices, model.volume.tets);
  std::string text = fmt::format(
      "input: {}\nextent: {:.1f} x {:.1f} x {:.1f} mm\nvisual mesh: {} vertices, {} triangles, texture "
      "coordinates: {}\n"
      "cage: {} vertices, {} triangles\ntets: {} vertices, {} tets, mean edge {:.1f} mm, volume {:.4g} cm^3, "
      "smallest tet "
      "{:.3g} cm^3\nwarnings: {}\n",
      mesh, extent[0], extent[1], extent[2], rest.rows(), model.visual.triangles.rows(),
      model.visual.texture_coordinates.rows() > 0 ? "yes" : "no", cage.vertices.rows(), cage.triangles.rows(),
      model.volume.rest_vertices.rows(), model.volume.tets.rows(),
      1e3 * meanEdgeLength(model.volume.rest_vertices, model.volume.tets), 1e6 * volumes.sum(),
      1e6 * volumes.minCoeff(), model.warnings.empty() ? "none" : "");
  for (const std::string& warning : model.warnings) text += "  " + warning + "\n";
  return text;
}

/// A folder beside the target that vanishes when done.
class StagingFolder {
 public:
  explicit StagingFolder(const fs::path& target)
      : path_(fmt::format("{}.{}.tmp", target.string(), getpid())) {
    fs::create_directories(path_);
  }
  ~StagingFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  const fs::path& path() const { return path_; }

  /// object.yaml comes last: whoever finds it finds what it names.
  void moveInto(const fs::path& target) const {
    fs::create_directories(target);
    for (const char* file : kFiles) fs::rename(path_ / file, target / file);
  }

 private:
  fs::path path_;
};

}  // namespace

void prepareModel(const std::string& mesh, const std::string& unit, const std::string& folder,
                  const VolumeSettings& settings, std::ostream& progress) {
  ObjectDescription description;
  description.visual_mesh = mesh;
  description.unit_m = metresPer(unit);
  progress << "reading " << mesh << ", making its cage and tets\n" << std::flush;
  const ObjectModel model = buildObjectModel(description, settings);
  const TriangleMesh cage = cageOf(model.volume);

  const fs::path target = fs::absolute(folder).lexically_normal();
  const StagingFolder staging(target.has_filename() ? target : target.parent_path());
  writeObj((staging.path() / "visual.obj").string(), {model.visual.rest_vertices, model.visual.triangles},
           model.visual.texture_coordinates);
  writeObj((staging.path() / "cage.obj").string(), cage);
  writeVtu((staging.path() / "tets.vtu").string(), {model.volume.rest_vertices, model.volume.tets});
  writeText(staging.path() / "report.txt", report(mesh, model, cage));
  writeText(staging.path() / "object.yaml", objectYaml(mesh, model.material));
  staging.moveInto(target);
  progress << report(mesh, model, cage) << "written to " << target.string() << '\n';
}

}  // namespace softbody
