// What a frame of hair on a moving mesh costs: 200,000 strands of 36 vertices from 10,000 guides of 7, skin -> targets
// -> smooth -> interpolate -> vertex buffer, on two CPU threads and as kernels in one submission (CUTICLE_DEVICE
// chooses the device): bench_strands_frame [bench/reference.json]. The best of 10 frames; memory over that of positions
// and tangents; then a kernel that does nothing but write as much, the floor of any frame on that device.
#include <fmt/core.h>
#include <tbb/global_control.h>
#include <ctime>
#include <glm/gtc/matrix_transform.hpp>

#include "strands/binding/binding.h"
#include "strands/skinning/skinning.h"
#include "strands/spline/vertex_stream.h"
#ifdef CUTICLE_HAS_GPU
#include "gpu/groups.h"
#include "strands/binding/carry_gpu.h"
#include "strands/skinning/skinning_gpu.h"
#include "strands/spline/smooth_gpu.h"

#include <vertex_stores_comp.spv.h>
#endif
#include "bench/calibration.h"

namespace {

using namespace cuticle;
using namespace cuticle::strands;

constexpr std::uint32_t k_side = 100;
constexpr int k_guide_vertices = 7, k_vertices = 36, k_frames = 10;
constexpr std::size_t k_strands = 200000;

/// A square metre of skin on two joints, a guide on each of its vertices, strands between them.
struct Fur {
  Mesh skin, moved;
  std::vector<Influences> influences;
  Groom guides;
  RestOnMesh rest;
  std::vector<std::array<std::uint32_t, 3>> hairs;
  std::vector<glm::vec3> weights;
};

void add_vertex(std::uint32_t i, Fur& fur) {
  const float x = float(i % k_side) / (k_side - 1), y = float(i / k_side) / (k_side - 1);
  fur.skin.positions.emplace_back(x, 0, y);
  fur.influences.push_back({{0, 1, 0, 0}, {1 - x, x, 0, 0}});
  for (int k = 0; k < k_guide_vertices; ++k)
    fur.guides.positions.emplace_back(x + 0.002f * float(k * k), 0.01f * float(k), y);
  fur.guides.offsets.push_back(std::uint32_t(fur.guides.positions.size()));
  if (i % k_side == k_side - 1 || i / k_side == k_side - 1) return;
  fur.skin.triangles.push_back({i, i + k_side, i + 1});
  fur.skin.triangles.push_back({i + 1, i + k_side, i + k_side + 1});
}

Fur make_fur() {
  Fur fur;
  for (std::uint32_t i = 0; i < k_side * k_side; ++i) add_vertex(i, fur);
  compute_normals(fur.skin);
  fur.guides.radii.assign(fur.guides.vertex_count(), k_default_radius);
  fur.moved = fur.skin;
  fur.rest = rest_on_mesh(fur.guides, fur.skin, bind_roots(fur.guides, fur.skin, 1e-3)->roots);
  for (const Root& root : scatter_roots(fur.skin, k_strands, 1)) {
    fur.hairs.push_back(fur.skin.triangles[root.triangle]);
    fur.weights.push_back(root.weights);
  }
  return fur;
}

std::vector<JointMotion> motions_of(int frame) {
  return joint_motions(std::vector{glm::dmat4(1), glm::rotate(glm::dmat4(1), 0.1 * frame, glm::dvec3(1, 0, 0))});
}

/// The quickest frame, and what all frames took of the processor on average, over all threads: the fairer number on a
/// busy machine.
struct Cost {
  double wall_ms = 0, processor_ms = 0;
};
template <class Frame>
Cost cost_of(const Frame& frame) {
  int k = 0;
  const std::clock_t begin = std::clock();
  const double wall_ms = bench::best_ms(k_frames, [&] { frame(k++); });
  return {wall_ms, 1e3 * double(std::clock() - begin) / CLOCKS_PER_SEC / k_frames};
}

void print(const char* where, const Cost& cost, double scale, std::size_t bytes) {
  const double output = double(k_strands) * k_vertices * 2 * sizeof(glm::vec4);
  fmt::print(
      "{:<12}{:8.1f} ms a frame ({:.1f} on the reference machine), {:8.1f} ms of processor time, memory {:.3f} x the "
      "output\n",
      where, cost.wall_ms, cost.wall_ms / scale, cost.processor_ms, double(bytes) / output);
}

void on_cpu(Fur& fur, double scale) {
  const tbb::global_control two_threads(tbb::global_control::max_allowed_parallelism, 2);
  auto stream = VertexStream::create(fur.guides, k_vertices, fur.hairs, fur.weights, k_default_radius);
  std::vector<glm::vec3> places(fur.guides.vertex_count());
  const Cost cost = cost_of([&](int frame) {
    skin(fur.skin, fur.influences, motions_of(frame), Skinning::dual_quaternion, fur.moved);
    carry(fur.rest, fur.moved, places);
    stream->update(places);
  });
  print("two threads", cost, scale, stream->bytes());
}

#ifdef CUTICLE_HAS_GPU
Result<void> stores_alone(gpu::Device& device, const StrandGenerator& strands, double scale) {
  constexpr std::uint32_t constants[] = {k_strands, k_vertices};
  constexpr gpu::ShaderInterface interface { .storage_buffers = 2, .push_constant_bytes = sizeof(constants) };
  CUTICLE_ASSIGN(const gpu::Kernel kernel, device.make_kernel(vertex_stores_comp, interface));
  const gpu::Groups groups = gpu::groups_for(k_strands);
  Result<void> outcome;
  const Cost cost = cost_of([&](int) {
    gpu::Commands commands = device.record();
    commands.dispatch(kernel, {&strands.vertices(), &strands.tangents()}, {}, std::as_bytes(std::span(constants)),
                      groups.x, groups.y);
    if (const auto done = device.submit(std::move(commands)); !done) outcome = done.error();
  });
  CUTICLE_TRY(outcome);
  print("its stores", cost, scale, strands.vertices().size() + strands.tangents().size());
  return {};
}

Result<void> on_device(const Fur& fur, double scale) {
  CUTICLE_ASSIGN(const auto device, gpu::Device::open());
  CUTICLE_ASSIGN(GpuSkin mesh, GpuSkin::create(*device, fur.skin, fur.influences, 2));
  CUTICLE_ASSIGN(GpuCarry guides, GpuCarry::create(*device, fur.rest));
  CUTICLE_ASSIGN(const auto strands, StrandGenerator::create(device, {.control = &fur.guides,
                                                                      .vertices_per_strand = k_vertices,
                                                                      .hairs = fur.hairs,
                                                                      .weights = fur.weights}));
  Result<void> outcome;
  const Cost cost = cost_of([&](int frame) {
    gpu::Commands commands = device->record();
    outcome = mesh.record(commands, motions_of(frame), Skinning::dual_quaternion);
    guides.record(commands, mesh.positions(), mesh.normals());
    if (outcome) outcome = strands->record_smooth(commands, guides.positions());
    if (outcome) outcome = strands->record_interpolate(commands);
    if (const auto done = device->submit(std::move(commands)); !done) outcome = done.error();
  });
  CUTICLE_TRY(outcome);
  fmt::print("{}\n", device->info().name);
  print("device", cost, scale, device->allocated_bytes());
  return stores_alone(*device, *strands, scale);
}
#endif

}  // namespace

int main(int argc, char** argv) {
  const double scale = argc > 1 ? bench::machine_scale(argv[1]) : 1;
  Fur fur = make_fur();
  on_cpu(fur, scale);
#ifdef CUTICLE_HAS_GPU
  if (const auto done = on_device(fur, scale); !done) fmt::print("device: {}\n", done.error().message);
#endif
}
