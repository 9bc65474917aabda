// What the solvers cost on two threads: bench_sim [reference.json] prints ms a frame (best of many), raw and scaled to
// the machine of that file, and the largest stretch. 1,000 and 10,000 strands of 32 vertices. Then the same by kernels on
// the device that CUTICLE_DEVICE chooses, submission and waiting included (threads: its name).
#include <cmath>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include <fmt/core.h>
#include <tbb/global_control.h>

#include "sim/telemetry.h"
#ifdef CUTICLE_HAS_GPU
#include "sim/solver_gpu.h"
#endif
#include "bench/calibration.h"

namespace {

using namespace cuticle;

struct Case {
  std::string name, solver, settings;
  int strands, threads;
  bool sphere = false, far_sphere = false;
  std::string effect = {};  ///< beside gravity
};

strands::Groom straight_strands(int count) {
  strands::Groom groom;
  for (int s = 0; s < count; ++s) {
    const float angle = 0.001f * float(s);
    for (int i = 0; i < 32; ++i)
      groom.positions.push_back(glm::vec3(std::cos(angle), 0, std::sin(angle)) * (0.3f * float(i) / 31));
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), strands::k_default_radius);
  return groom;
}

registry::ParameterValues values_of(const std::string& effect, const std::string& settings) {
  return registry::parse_assignments((*sim::find_effect(effect))->entry.parameters, settings).value();
}

sim::EffectBlocks effects_of(const Case& c) {
  sim::EffectBlocks effects{{"gravity", values_of("gravity", "")}};
  if (c.sphere || c.far_sphere) effects["colliders"] = values_of("colliders", "pearl_radius=0");
  if (!c.effect.empty()) effects[c.effect] = values_of(c.effect, "");
  return effects;
}

/// Times frames of `solver` and prints them; `on`: the threads or the device.
void measure(const Case& c, const strands::Groom& groom, sim::Solver& solver, const std::string& on, double scale) {
  const Sphere ball{{c.far_sphere ? 5 : 0.1, -0.2, 0}, 0.05};
  sim::FrameInput input;
  if (c.sphere || c.far_sphere) input.colliders = {&ball, 1};
  const int frames = (c.strands > 1000 ? 60 : 300) / (c.threads > 0 ? 1 : 12);  // software Vulkan takes seconds a frame
  const double best = bench::best_ms(frames, [&] {
    if (!solver.advance(input)) std::abort();
  });
  const sim::Telemetry telemetry = sim::measure(groom, solver.state().value());
  fmt::print("{},{},{},{:.3f},{:.3f},{:.1e}\n", c.name, c.strands, on, best, best / scale, telemetry.largest_stretch - 1);
}

void run(const Case& c, double scale) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, std::size_t(c.threads));
  const strands::Groom groom = straight_strands(c.strands);
  const auto solver =
      (*sim::find_effect(c.solver))->create(groom, values_of(c.solver, c.settings), effects_of(c)).value();
  measure(c, groom, *solver, std::to_string(c.threads), scale);
}

#ifdef CUTICLE_HAS_GPU
/// Says why where there is no device.
void run_on_device(std::span<const Case> cases, double scale) {
  const auto device = gpu::Device::open();
  if (!device) return fmt::print("{}\n", device.error().message);
  for (const Case& c : cases) {
    const strands::Groom groom = straight_strands(c.strands);
    const auto solver = (*sim::find_gpu_effect(c.solver))
                            ->create(*device, groom, values_of(c.solver, c.settings), effects_of(c))
                            .value();
    measure(c, groom, *solver, fmt::format("\"{}\"", (*device)->info().name), scale);
  }
}
#else
void run_on_device(std::span<const Case>, double) {}
#endif

}  // namespace

int main(int argc, char** argv) {
  double scale = 1;
  if (argc > 1) scale = bench::machine_scale(argv[1]);
  const std::string four = "damping=0,shape_stiffness=0,clamped_vertices=1,inner_step=0.00417,max_substeps=4";
  const std::string eight = "damping=0,inner_step=0.00209,max_substeps=8";
  fmt::print("case,strands,threads,best_ms,best_scaled_ms,largest_stretch\n");
  for (int threads : {1, 2}) {
    run({"exact, 4 substeps", "exact", four, 1000, threads}, scale);
    run({"exact, 4 substeps, sphere", "exact", four, 1000, threads, true}, scale);
    run({"exact, 4 substeps, sphere out of reach", "exact", four, 1000, threads, false, true}, scale);
    run({"exact, 4 substeps, wind", "exact", four, 1000, threads, false, false, "wind"}, scale);
    run({"exact, 4 substeps, water", "exact", four, 1000, threads, false, false, "water"}, scale);
    const std::string beside = "strand_interaction";
    run({"exact, 4 substeps, strand against strand", "exact", four, 1000, threads, false, false, beside}, scale);
    run({"exact, 4 substeps, clumps", "exact", four, 1000, threads, false, false, "clumping"}, scale);
    const std::string pulled = "inner_step=0.00417,max_substeps=4";
    run({"exact, 4 substeps, pull to the rest pose", "exact", pulled, 1000, threads}, scale);
    run({"exact, 4 substeps, pull to the rest pose, asleep", "exact", pulled, 1000, threads, false, false, "sleep"},
        scale);
    run({"exact, 4 substeps", "exact", four, 10000, threads}, scale);
    run({"rod, 8 substeps", "rod", eight, 1000, threads}, scale);
    run({"rod, 8 substeps, sphere", "rod", eight, 1000, threads, true}, scale);
    run({"rod, 8 substeps, strand against strand", "rod", eight, 1000, threads, false, false, beside}, scale);
    run({"rod, 8 substeps, clumps", "rod", eight, 1000, threads, false, false, "clumping"}, scale);
    run({"rod, 8 substeps, asleep", "rod", eight + ",fibre_radius=1e-3", 1000, threads, false, false, "sleep"}, scale);
    run({"rod, 8 substeps", "rod", eight, 10000, threads}, scale);
  }
  run({"classic, 4 substeps of 4 sweeps", "classic", four, 1000, 2}, scale);
  run_on_device(std::vector<Case>{{"exact, 4 substeps", "exact", four, 1000, 0},
                                  {"exact, 4 substeps, sphere", "exact", four, 1000, 0, true},
                                  {"exact, 4 substeps", "exact", four, 10000, 0},
                                  {"rod, 8 substeps", "rod", eight, 1000, 0},
                                  {"rod, 8 substeps", "rod", eight, 10000, 0}},
                scale);
}
