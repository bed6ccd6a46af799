#include "softbody_sim/report/model_folder.h"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <ostream>
#include <stdexcept>
#include <string_view>

#include "report/model_picture.h"
#include "report/model_quality.h"
#include "report/model_skin.h"
#include "report/model_verdict.h"
#include "softbody_common/files/input_file.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/io/surface_files.h"
#include "softbody_sim/io/tet_files.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

constexpr double kReportShare = 0.95;  // of the progress, when the report is made
constexpr std::array<const char*, 9> kFiles{kSkinFiles[0],       kSkinFiles[1],      kSkinFiles[2],
                                            "visual.obj",        "cage.obj",         "tets.vtu",
                                            "report/models.png", "report/report.md", "object.yaml"};
constexpr std::string_view kMark = "# Made by prepare_model";  // how an object.yaml begins

std::string objectYaml(const std::string& mesh, const Material& material) {
  return fmt::format(
      "{} from {}. The material is a guess (soft foam); set it to yours.\n"
      "object:\n  visual_mesh: visual.obj\n  cage_mesh: cage.obj\n  tet_mesh: tets.vtu\n"
      "  material: {{youngs_modulus_pa: {}, poisson_ratio: {}, density_kg_m3: {}, damping: {}}}\n"
      "  # initial_pose: [x, y, z, qx, qy, qz, qw]   # in the colour optical frame, approximate; without it "
      "the object is searched for\n",
      kMark, fs::path(mesh).filename().string(), material.youngs_modulus_pa, material.poisson_ratio,
      material.density_kg_m3, material.damping);
}

std::string report(const std::string& mesh, const ObjectModel& model, const ModelQuality& q,
                   const std::vector<Judgement>& judgements) {
  const Points& rest = model.visual.rest_vertices;
  const Eigen::RowVector3d extent = 1e3 * (rest.colwise().maxCoeff() - rest.colwise().minCoeff());
  std::string text =
      fmt::format("# {}\n\n{:.1f} x {:.1f} x {:.1f} mm, texture coordinates: {}\n\n", mesh, extent[0],
                  extent[1], extent[2], model.visual.texture_coordinates.rows() > 0 ? "yes" : "no");
  text += fmt::format("**Verdict: {}.**\n\n| | |\n|---|---|\n", nameOf(worst(judgements)));
  for (const Judgement& judgement : judgements)
    text += fmt::format("| {} | {} |\n", nameOf(judgement.verdict), judgement.sentence);
  text += "\n![visual mesh, cage and tets](models.png)\n\n";
  text += "| | this object | sponge of Kang et al. 2022 | doll of Kang et al. 2022 |\n|---|---|---|---|\n";
  text += fmt::format("| visual vertices | {} | 522 | 18650 |\n| visual triangles | {} | 1040 | 7190 |\n",
                      q.visual_vertices, q.visual_triangles);
  text += fmt::format("| cage vertices | {} | 132 | 128 |\n| cage triangles | {} | 260 | 252 |\n",
                      q.cage_vertices, q.cage_triangles);
  text +=
      fmt::format("| tet vertices | {} | 132 | 154 |\n| tets | {} | 300 | 494 |\n\n", q.tet_vertices, q.tets);
  text += fmt::format(
      "- visual vertices outside of the cage: {}\n- margin to the cage: {:.3g} to {:.3g} mm, mean {:.3g} "
      "mm\n",
      q.outside, 1e3 * q.least_margin, 1e3 * q.largest_margin, 1e3 * q.mean_margin);
  text += fmt::format("- volume of the cage: {:.4g} cm^3{}\n", 1e6 * q.cage_volume,
                      q.visual_volume > 0.0
                          ? fmt::format(", {:.2f} of the visual mesh's", q.cage_volume / q.visual_volume)
                          : "");
  text +=
      fmt::format("- mean edge: {:.1f} mm; longest over shortest edges of the cage (95 % over 5 %): {:.2f}\n",
                  1e3 * meanEdgeLength(model.volume.rest_vertices, model.volume.tets), q.edge_spread);
  text += fmt::format(
      "- dihedral angles: {:.1f} to {:.1f} degrees; 1 tet in 100 has one below {:.1f}\n- smallest tet: "
      "{:.3g} cm^3\n",
      q.smallest_dihedral, q.largest_dihedral, q.dihedral_percentile, 1e6 * q.smallest_tet);
  text += fmt::format(
      "- mean value coordinates: sum to 1 within {:.1e}, reproduce the visual vertices within {:.1e} of the "
      "size\n",
      q.partition_error, q.reproduction_error / q.size);
  return text;
}

/// Refuses to replace what prepare_model did not make. @throw std::runtime_error
void requireReplaceable(const fs::path& folder) {
  std::error_code unknown;
  const fs::path yaml = folder / kFiles.back();
  const bool is_model = fs::is_regular_file(fs::symlink_status(yaml, unknown)) &&
                        readFile(yaml).compare(0, kMark.size(), kMark) == 0;
  for (const char* file : kFiles) {
    const fs::file_status status = fs::symlink_status(folder / file, unknown);
    if (!fs::exists(status) || (is_model && fs::is_regular_file(status))) continue;
    throw std::runtime_error(
        fmt::format("{} was not made by prepare_model; choose another folder", (folder / file).string()));
  }
}

void writePicture(const fs::path& path, const cv::Mat& picture) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(path.extension().string(), picture, bytes);
  writeBytes(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// object.yaml comes last: the files that it names then exist.
void moveFiles(const fs::path& from, const fs::path& to) {
  fs::create_directories(to / "report");
  for (const char* file : kFiles) {
    if (fs::exists(from / file)) fs::rename(from / file, to / file);
  }
}

}  // namespace

Verdict prepareModel(const ModelSource& source, const std::string& folder, const VolumeSettings& settings,
                     std::ostream& output) {
  const fs::path target = fs::weakly_canonical(fs::absolute(folder));
  requireReplaceable(target);
  ObjectDescription description;
  description.visual_mesh = source.mesh;
  description.unit_m = source.scale > 0.0 ? source.scale : metresPer(source.unit);
  description.body = source.body;
  VolumeSettings making = settings;
  making.progress = [&](double fraction) { settings.progress(kModelShare * fraction); };
  ObjectModel model = buildObjectModel(description, making);
  const TriangleMesh cage = cageOf(model.volume);

  const StagedFolder staging(target);
  fs::create_directories(staging.path() / "report");
  const std::string material_file = writeSkin(source.mesh, staging.path(), &model.warnings);
  writeObj((staging.path() / "visual.obj").string(), {model.visual.rest_vertices, model.visual.triangles},
           {model.visual.texture_coordinates, material_file,
            colorsOfVertices(model.visual, readVertexColors(source.mesh))});
  writeObj((staging.path() / "cage.obj").string(), cage);
  writeVtu((staging.path() / "tets.vtu").string(), {model.volume.rest_vertices, model.volume.tets});
  const ModelQuality quality = measureModel(model);
  const std::vector<Judgement> judgements = judgementsOf(model, quality);
  const std::string text = report(source.mesh, model, quality, judgements);
  writeBytes(staging.path() / "report/report.md", text);
  writePicture(staging.path() / "report/models.png", drawModel(model));
  writeBytes(staging.path() / "object.yaml", objectYaml(source.mesh, model.material));
  settings.progress(kReportShare);
  moveFiles(staging.path(), target);
  settings.progress(1.0);
  output << text << "written to " << target.string() << '\n';
  return worst(judgements);
}

}  // namespace softbody
