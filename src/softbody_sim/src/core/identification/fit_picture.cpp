#include "softbody_sim/identification/fit_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/drawing/mesh_drawing.h"

namespace softbody {
namespace {

const cv::Size kPanel(560, 480);
const cv::Scalar kInk(40, 40, 40), kBefore(170, 170, 170), kAfter(180, 90, 20);
const cv::Vec3d kUnseen(215, 215, 215);

void write(const std::string& words, const cv::Point& place, cv::Mat3b* image) {
  cv::putText(*image, words, place, cv::FONT_HERSHEY_SIMPLEX, 0.5, kInk, 1, cv::LINE_AA);
}

/// Per vertex: mean signed distance of the simulated surface from the measured places [m], and its weight.
struct VertexResiduals {
  Eigen::VectorXd sum, weight;

  VertexResiduals(const MaterialProblem& problem, const ShapeObservation& observation, const Points& shape) {
    sum.setZero(shape.rows());
    weight.setZero(shape.rows());
    const Points normals = vertexNormals(shape, problem.topology.surface);
    for (const Target& target : observation.targets) {
      Eigen::Vector3d normal = target.normal;
      if (normal.isZero(0.0)) normal = positionOf(target.place, normals, problem.topology.tets);
      if (!(normal.norm() > 0.0)) continue;
      const double distance =
          normal.normalized().dot(positionOf(target.place, shape, problem.topology.tets) - target.position);
      for (int k = 0; k < 4; ++k) {
        const int v = problem.topology.tets(target.place.tet, k);
        const double share = std::max(0.0, target.place.barycentric[k]);
        sum[v] += share * distance;
        weight[v] += share;
      }
    }
  }
  bool has(int v) const { return weight[v] > 0.0; }
  double at(int v) const { return sum[v] / weight[v]; }
};

/// Blue: too low, white: right, red: too high.
cv::Vec3d colorOf(double share) {
  const double s = std::clamp(share, -1.0, 1.0), pale = 255.0 * (1.0 - std::abs(s));
  return s < 0.0 ? cv::Vec3d(255, pale, pale) : cv::Vec3d(pale, pale, 255);
}

cv::Mat3b drawBody(const MaterialProblem& problem, const MaterialEstimate& estimate) {
  std::size_t last = problem.observations.size() - 1;
  while (last > 0 && problem.observations[last].targets.empty()) --last;
  const Points& shape = estimate.shapes[last];
  const VertexResiduals residuals(problem, problem.observations[last], shape);
  double largest = 1e-9;
  for (int v = 0; v < shape.rows(); ++v)
    if (residuals.has(v)) largest = std::max(largest, std::abs(residuals.at(v)));
  MeshPaint paint;
  paint.edges = true;
  for (const auto& triangle : problem.topology.surface.rowwise()) {
    double sum = 0.0, count = 0.0;
    for (const int v : triangle)
      if (residuals.has(v)) sum += residuals.at(v), count += 1.0;
    paint.colors.push_back(count > 0.0 ? colorOf(sum / count / largest) : kUnseen);
  }
  cv::Mat3b image = drawMesh(shape, problem.topology.surface, paint, viewOf(shape, kPanel));
  write(fmt::format("simulated - measured: red +{0:.2g} mm, blue -{0:.2g} mm, grey not seen", 1e3 * largest),
        {12, kPanel.height - 14}, &image);
  return image;
}

/// A row of values as points with lines between them.
struct Curve {
  std::string name;
  std::vector<double> values;
  cv::Scalar color;
};

cv::Mat3b drawCurves(const std::string& title, const std::vector<Curve>& curves) {
  const cv::Rect area(70, 70, 460, 350);
  cv::Mat3b image(kPanel, cv::Vec3b(255, 255, 255));
  double top = 0.0, bottom = 0.0;
  for (const Curve& curve : curves)
    for (const double value : curve.values) top = std::max(top, value), bottom = std::min(bottom, value);
  if (!(top > bottom)) top = bottom + 1.0;
  const auto place = [&](std::size_t k, std::size_t count, double value) {
    const double x = count < 2 ? 0.5 : static_cast<double>(k) / static_cast<double>(count - 1);
    return cv::Point2d(area.x + x * area.width,
                       area.br().y - (value - bottom) / (top - bottom) * area.height);
  };
  cv::rectangle(image, area, kInk);
  write(title, {area.x, 24}, &image);
  write(fmt::format("{:.3g}", top), {8, area.y + 12}, &image);
  write(fmt::format("{:.3g}", bottom), {8, area.br().y}, &image);
  write("observation", {area.br().x - 100, area.br().y + 30}, &image);
  int x = area.x;
  for (const Curve& curve : curves) {
    cv::putText(image, curve.name, {x, 50}, cv::FONT_HERSHEY_SIMPLEX, 0.5, curve.color, 1, cv::LINE_AA);
    x += 230;
    for (std::size_t k = 0; k < curve.values.size(); ++k) {
      const cv::Point2d point = place(k, curve.values.size(), curve.values[k]);
      cv::circle(image, point, 4, curve.color, cv::FILLED, cv::LINE_AA);
      if (k > 0)
        cv::line(image, place(k - 1, curve.values.size(), curve.values[k - 1]), point, curve.color, 2,
                 cv::LINE_AA);
    }
  }
  return image;
}

cv::Mat3b drawForces(const MaterialProblem& problem, const MaterialEstimate& estimate) {
  Curve measured{"measured", {}, kBefore}, simulated{"simulated", {}, kAfter};
  for (std::size_t k = 0; k < problem.observations.size(); ++k)
    for (std::size_t w = 0; w < problem.observations[k].wrenches.size(); ++w) {
      measured.values.push_back(problem.observations[k].wrenches[w].value.force.norm());
      simulated.values.push_back(estimate.observations[k].wrenches[w].force.norm());
    }
  return measured.values.empty() ? cv::Mat3b() : drawCurves("Force [N]", {measured, simulated});
}

}  // namespace

cv::Mat3b drawFit(const MaterialProblem& problem, const MaterialEstimate& estimate) {
  Curve before{"material of the object", {}, kBefore}, after{"found material", {}, kAfter};
  for (const ObservationFit& fit : estimate.observations) {
    before.values.push_back(1e3 * fit.rms_before_m);
    after.values.push_back(1e3 * fit.rms_after_m);
  }
  std::vector<cv::Mat3b> panels{drawBody(problem, estimate),
                                drawCurves("Residual, rms [mm]", {before, after})};
  if (const cv::Mat3b forces = drawForces(problem, estimate); !forces.empty()) panels.push_back(forces);
  cv::Mat3b picture;
  cv::hconcat(panels, picture);
  return picture;
}

}  // namespace softbody
