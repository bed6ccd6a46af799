#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "bench/doll_size.h"
#include "bench/mean_value_reference.h"
#include "bench/wall_time.h"
#include "softbody_common/statistics/median.h"
#include "softbody_sim/interpolation/tiled_weights.h"
#include "softbody_sim/mean_value/mean_value_coordinates.h"

/// Mean value coordinates of the doll of Kang et al. 2022 (18,650 points, 252 faces), one thread. For the
/// ratios both programs take turns in one run, so that the machine's load affects both.
namespace {

using namespace softbody;
using bench::secondsOf;

const bench::DollSize& doll() {
  static const bench::DollSize kept = bench::makeDollSize();
  return kept;
}

void makeProductWeights(WeightRows* weights) {
  MeanValueCage(doll().cage.vertices, doll().cage.triangles).coordinates(doll().points, weights);
}

template <typename Scalar>
void makeReferenceWeights(WeightRows* weights) {
  bench::referenceMeanValueCoordinates<Scalar>(doll().points, doll().cage.vertices, doll().cage.triangles,
                                               weights);
}

/// Largest difference, relative to the largest weight of its row.
double relativeDifference(const WeightRows& weights, const WeightRows& exact) {
  const Eigen::VectorXd difference = (weights - exact).cwiseAbs().rowwise().maxCoeff();
  return difference.cwiseQuotient(exact.cwiseAbs().rowwise().maxCoeff()).maxCoeff();
}

void makeWeights(benchmark::State& state) {
  std::vector<double> ratios;
  WeightRows weights, scalar;
  for (auto _ : state) {
    const double product = secondsOf([&weights] { makeProductWeights(&weights); });
    const double reference = secondsOf([&scalar] { makeReferenceWeights<double>(&scalar); });
    ratios.push_back(reference / product);
    state.SetIterationTime(product);
  }
  WeightRows exact;
  makeReferenceWeights<long double>(&exact);
  state.counters["summary/mvc_weights_ratio"] = medianOf(ratios);
  state.counters["difference"] = relativeDifference(weights, exact);
  state.counters["difference_of_scalar_port"] = relativeDifference(scalar, exact);
}
BENCHMARK(makeWeights)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(9);

struct Apply {
  Apply() : values(TiledWeights::Values::Random(doll().cage.vertices.rows(), 4)) {
    WeightRows weights;
    makeProductWeights(&weights);
    tiled = TiledWeights(weights.cols());
    for (Eigen::Index p = 0; p < weights.rows(); ++p) tiled.append(weights.row(p));
    rows = weights.cast<float>();
    columns = rows;
  }
  TiledWeights tiled;
  Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows;
  Eigen::MatrixXf columns;
  TiledWeights::Values values;
};

const Apply& apply() {
  static const Apply kept;
  return kept;
}

/// Three coordinates and a confidence, as the surface interpolates them. Eigen's product is the faster of
/// those of weights in rows and in columns.
void applyWeights(benchmark::State& state) {
  const Apply& a = apply();
  const Eigen::MatrixX4f values = a.values;
  TiledWeights::Products product;
  Eigen::MatrixX4f eigen(a.rows.rows(), 4);
  std::vector<double> ratios;
  for (auto _ : state) {
    const double ours = secondsOf([&] { a.tiled.multiply(a.values, &product); });
    const double by_rows = secondsOf([&] { eigen.noalias() = a.rows * values; });
    const double by_columns = secondsOf([&] { eigen.noalias() = a.columns * values; });
    ratios.push_back(std::min(by_rows, by_columns) / ours);
    state.SetIterationTime(ours);
  }
  state.counters["summary/mvc_apply_ratio"] = medianOf(ratios);
  state.counters["difference"] = (product.topRows(eigen.rows()) - eigen).array().abs().maxCoeff();
}
BENCHMARK(applyWeights)->Unit(benchmark::kMillisecond)->UseManualTime()->Iterations(200);

}  // namespace

BENCHMARK_MAIN();
