#include "corpus/mesh_mutations.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "fixtures/box_meshes.h"
#include "fixtures/model_files.h"

namespace softbody::test {
namespace {

double sizeOfMesh(const TriangleMesh& mesh) {
  return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
}

TriangleMesh moved(TriangleMesh mesh, const Eigen::RowVector3d& by) {
  mesh.vertices.rowwise() += by;
  return mesh;
}

TriangleMesh scaled(TriangleMesh mesh, double factor) {
  mesh.vertices *= factor;
  return mesh;
}

TriangleMesh loneTriangle(const Eigen::RowVector3d& at, double size) {
  TriangleMesh mesh{Points(3, 3), Triangles(1, 3)};
  mesh.vertices << at, at + Eigen::RowVector3d(size, 0, 0), at + Eigen::RowVector3d(0, size, 0);
  mesh.triangles << 0, 1, 2;
  return mesh;
}

/// Every triangle with its own vertices, in single precision, as in STL.
TriangleMesh exploded(const TriangleMesh& mesh) {
  TriangleMesh result{Points(mesh.triangles.size(), 3), mesh.triangles};
  std::iota(result.triangles.reshaped<Eigen::RowMajor>().begin(),
            result.triangles.reshaped<Eigen::RowMajor>().end(), 0);
  for (Eigen::Index corner = 0; corner < mesh.triangles.size(); ++corner)
    result.vertices.row(corner) =
        mesh.vertices.row(mesh.triangles(corner / 3, corner % 3)).cast<float>().cast<double>();
  return result;
}

class Mutator {
 public:
  Mutator(const SoundMesh& sound, unsigned seed)
      : sound_(sound),
        random_(seed),
        volume_(enclosedVolume(sound.mesh.vertices, sound.mesh.triangles)),
        size_(sizeOfMesh(sound.mesh)) {}

  std::vector<MutatedMesh> all() {
    add("clean", sound_.mesh);
    add("inside out", insideOut(sound_.mesh));
    addFaceDefects();
    addLooseParts();
    addShells();
    addCoordinates();
    return std::move(meshes_);
  }

 private:
  void add(const std::string& kind, TriangleMesh mesh) { add(kind, std::move(mesh), volume_); }
  void add(const std::string& kind, TriangleMesh mesh, std::optional<double> volume, double unit_m = 1.0) {
    meshes_.push_back({sound_.name, kind, std::move(mesh), unit_m, volume});
  }

  Eigen::Index anyFace() { return static_cast<Eigen::Index>(random_() % sound_.mesh.triangles.rows()); }
  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  int few() const { return std::max<int>(1, static_cast<int>(sound_.mesh.triangles.rows() / 50)); }

  void addFaceDefects() {
    const TriangleMesh& sound = sound_.mesh;
    TriangleMesh mesh = sound;
    for (int k = 0; k < few(); ++k) mesh.triangles.row(anyFace()) << 0, 0, 0;
    add("deleted faces", mesh);
    for (int k = 0; k < few(); ++k)
      mesh = together({mesh, moved(loneTriangle({0, 0, 0}, 0.02 * size_), mesh.vertices.row(k))});
    add("moved faces", mesh);
    mesh = sound;
    for (int k = 0; k < few(); ++k) std::swap(mesh.triangles(k, 0), mesh.triangles(k, 1));
    add("flipped faces", mesh);
    mesh = sound;
    mesh.triangles.conservativeResize(sound.triangles.rows() + few(), 3);
    for (int k = 0; k < few(); ++k) {
      Eigen::RowVector3i copy = sound.triangles.row(anyFace());
      if (k % 2 == 0) std::swap(copy[0], copy[2]);
      mesh.triangles.row(sound.triangles.rows() + k) = copy;
    }
    add("doubled faces", mesh);
    add("two-sided", together({sound, insideOut(sound)}));
    add("a hole", withHole());
  }

  /// Without the triangles around one of them.
  TriangleMesh withHole() {
    TriangleMesh mesh = sound_.mesh;
    const Eigen::RowVector3d centre = mesh.vertices.row(mesh.triangles(anyFace(), 0));
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
      if ((mesh.vertices.row(mesh.triangles(f, 0)) - centre).norm() < 0.05 * size_)
        mesh.triangles.row(f) << 0, 0, 0;
    }
    return mesh;
  }

  void addLooseParts() {
    const TriangleMesh& sound = sound_.mesh;
    const Eigen::RowVector3d far = 5.0 * size_ * Eigen::RowVector3d(1.0, uniform(), uniform());
    add("a speck", together({sound, loneTriangle(far, 1e-3 * size_)}));
    TriangleMesh mesh = together({{(Points(1, 3) << 100.0 * far).finished(), Triangles(0, 3)}, sound});
    add("an unused vertex", mesh);
    mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
    mesh.triangles.bottomRows(1) << 1, 1, 0;
    add("a needle", mesh);
    const Eigen::RowVector3d low = sound.vertices.colwise().minCoeff();
    TriangleMesh floor{Points(4, 3), (Triangles(2, 3) << 0, 1, 2, 0, 2, 3).finished()};
    floor.vertices << -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0;
    add("a floor", together({moved(scaled(floor, 3.0 * size_), {0, 0, low.z() - 1e-3 * size_}), sound}));
  }

  void addShells() {
    const TriangleMesh& sound = sound_.mesh;
    const Eigen::RowVector3d extent =
        sound.vertices.colwise().maxCoeff() - sound.vertices.colwise().minCoeff();
    add("an exact copy", together({sound, sound}));
    const TriangleMesh crossing =
        together({sound, moved(sound, 0.31 * extent.cwiseProduct(Eigen::RowVector3d(1.0, 0.13, 0.07)))});
    add("a crossing copy", crossing, countedVolume(crossing, 120));
    add("an equal body beside it", together({sound, moved(sound, {1.5 * extent.x(), 0, 0})}), std::nullopt);
    add("a small body beside it", together({scaled(moved(sound, {5.0 * extent.x(), 0, 0}), 0.2), sound}));
  }

  void addCoordinates() {
    const TriangleMesh& sound = sound_.mesh;
    add("millimetres", scaled(sound, 1000.0), volume_, 0.001);
    add("own vertices for each face", exploded(sound));
    add("far from the origin", exploded(moved(sound, Eigen::RowVector3d(20.0, -30.0, 10.0) * size_)));
    TriangleMesh noisy = sound;
    const double edge =
        (sound.vertices.row(sound.triangles(0, 0)) - sound.vertices.row(sound.triangles(0, 1))).norm();
    for (double& x : noisy.vertices.reshaped()) x += 0.02 * edge * uniform();
    add("noise", noisy, enclosedVolume(noisy.vertices, noisy.triangles));
  }

  const SoundMesh& sound_;
  std::mt19937 random_;
  double volume_, size_;
  std::vector<MutatedMesh> meshes_;
};

/// A ball with waves.
TriangleMesh bumpyBall() {
  TriangleMesh mesh = boxMesh({2, 2, 2}, {0, 0, 0}, {12, 12, 12});
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const Eigen::RowVector3d p = mesh.vertices.row(v).normalized();
    mesh.vertices.row(v) = 0.08 * (1.0 + 0.1 * std::sin(5.0 * p.x()) * std::cos(4.0 * p.y())) * p;
  }
  return mesh;
}

TriangleMesh ell() {
  TriangleMesh mesh = boxMesh({0.2, 0.1, 0.04}, {0, 0, 0}, {10, 5, 2});
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {  // bent by a right angle
    const double angle = 5.0 * mesh.vertices(v, 0), radius = 0.2 + mesh.vertices(v, 1);
    mesh.vertices.row(v) << radius * std::sin(angle), radius * std::cos(angle), mesh.vertices(v, 2);
  }
  return mesh;
}

}  // namespace

std::vector<SoundMesh> simpleMeshes() {
  return {{"box", boxMesh({0.2, 0.1, 0.04}, {0, 0, 0}, {10, 5, 2})},
          {"bow", ell()},
          {"torus", torus(0.1, 0.03, 60, 24)},
          {"ball", bumpyBall()}};
}

std::vector<MutatedMesh> mutationsOf(const SoundMesh& sound, unsigned seed) {
  return Mutator(sound, seed).all();
}

double countedVolume(const TriangleMesh& mesh, int cells) {
  const Eigen::Array3d low = mesh.vertices.colwise().minCoeff().transpose(),
                       high = mesh.vertices.colwise().maxCoeff().transpose();
  const Eigen::Array3d cell = (high - low) / cells;
  // Along each ray in z: where the surface is met, and how the winding number changes there.
  std::vector<std::vector<std::pair<double, int>>> rays(static_cast<std::size_t>(cells * cells));
  for (const auto& t : mesh.triangles.rowwise()) {
    const Eigen::Array3d a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]),
                         c = mesh.vertices.row(t[2]);
    const double area = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
    if (area == 0.0) continue;
    const Eigen::Array3d first = (a.min(b).min(c) - low) / cell - 1.0,
                         last = (a.max(b).max(c) - low) / cell + 1.0;
    for (int i = std::max(0, static_cast<int>(first.x())); i < std::min<double>(cells, last.x()); ++i) {
      for (int j = std::max(0, static_cast<int>(first.y())); j < std::min<double>(cells, last.y()); ++j) {
        // Not in the middle of the cells, where regular meshes have edges.
        const double x = low.x() + (i + 0.4871) * cell.x(), y = low.y() + (j + 0.5137) * cell.y();
        const double u = ((x - a.x()) * (c - a).y() - (y - a.y()) * (c - a).x()) / area;
        const double v = ((b - a).x() * (y - a.y()) - (b - a).y() * (x - a.x())) / area;
        if (u < 0.0 || v < 0.0 || u + v >= 1.0) continue;
        rays[static_cast<std::size_t>(i * cells + j)].emplace_back(a.z() + u * (b - a).z() + v * (c - a).z(),
                                                                   area < 0.0 ? 1 : -1);
      }
    }
  }
  double length = 0.0;
  for (auto& ray : rays) {
    std::sort(ray.begin(), ray.end());
    int winding = 0;
    for (std::size_t k = 0; k + 1 < ray.size(); ++k) {
      winding += ray[k].second;
      if (winding > 0) length += ray[k + 1].first - ray[k].first;
    }
  }
  return length * cell.x() * cell.y();
}

}  // namespace softbody::test
