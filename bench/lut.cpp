// What baking tables costs on two threads, and how near its means of N are to a quadrature: bench_lut [reference.json]
// scales the times to the machine of that file.
#include <algorithm>
#include <string>

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include "lut/evaluate.h"
#include "bench/calibration.h"

namespace {

using namespace cuticle;
using namespace cuticle::lut;

double machine_scale = 1;  // this machine's time over that of the reference machine

struct Subject {
  const bsdf::Model& model;
  registry::ParameterValues values;
  const Layout& layout;
};
Subject subject_of(const char* settings, const char* layout) {
  const bsdf::Model& model = **bsdf::find_model("marschner");
  return {model, *bsdf::parse_settings(model, "", settings), **find_layout(layout)};
}

/// Largest difference of a channel of means from adaptive quadrature, over the channel's largest value.
double largest_error_of_means(const Subject& subject, const TableSet& set) {
  Source source = cpu_source(subject.model, subject.values);
  source.azimuthal_means = {};
  double worst = 0;
  for (std::size_t t = 0; t < set.tables.size(); ++t) {
    if (set.tables[t].layout->channels[0].texel != Texel::cell_average) continue;
    const Table truth = *bake_table(source, *set.tables[t].layout, set.size);
    double difference = 0, largest = 0;
    for (std::size_t i = 0; i < truth.image.pixels.size(); ++i) {
      largest = std::max(largest, double(truth.image.pixels[i]));
      difference =
          std::max(difference, std::abs(double(truth.image.pixels[i]) - double(set.tables[t].image.pixels[i])));
    }
    worst = std::max(worst, difference / largest);
  }
  return worst;
}

void bake_tables(benchmark::State& state, const char* settings, const char* layout) {
  const tbb::global_control two_threads(tbb::global_control::max_allowed_parallelism, 2);
  const Subject subject = subject_of(settings, layout);
  double best = 1e30;
  TableSet set;
  for (auto _ : state) {
    set = *bake(subject.model, subject.values, subject.layout, int(state.range(0)), silent_progress());
    best = std::min(best, set.bake_ms);
  }
  state.counters["best_ms"] = best;
  state.counters["best_scaled_ms"] = best / machine_scale;
  state.counters["means_error"] = largest_error_of_means(subject, set);
}

BENCHMARK_CAPTURE(bake_tables, nalu, "", "nalu")->Arg(64)->Arg(128)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(bake_tables, nalu_caustic, "", "nalu_caustic")->Arg(128)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(bake_tables, nalu2, "", "nalu2")->Arg(128)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK_CAPTURE(bake_tables, nalu_smoothed, "caustic=smoothed", "nalu")
    ->Arg(128)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc > 1) machine_scale = bench::machine_scale(argv[1]);
  benchmark::RunSpecifiedBenchmarks();
}
