// What leaving out the receiver's own fibre adds to a lookup, on one thread of the CPU and on the device that
// CUTICLE_DEVICE chooses: bench_shadows [GROOM METRES_PER_UNIT RADIUS_M], else a coat of 5,000 strands. On the CPU the
// same vertices are looked up as points of their strands and as free points; on the device the groom is followed by
// copies that cast nothing and so have no fibre to leave out. The least of several runs, taken in turns.
#include <algorithm>
#include <array>
#include <cstdio>

#include <fmt/core.h>
#include <tbb/global_control.h>

#include "bench/calibration.h"
#include "core/expect.h"
#include "shadows/method.h"
#include "strands/formats/formats.h"
#include "study/shadows/slices_study.h"
#ifdef CUTICLE_HAS_GPU
#include "shadows/groom_gpu.h"
#endif

namespace {

using namespace cuticle;

constexpr int k_turns = 5;
constexpr double k_alpha = 0.4;

struct Setting {
  std::string_view method;
  std::string set;
};
const Setting k_settings[] = {{"deep_opacity", "layers=8,resolution=512"},
                              {"deep_opacity", "layers=8,resolution=512,filter_texels=2"},
                              {"deep_opacity", "layers=8,resolution=512,storage=bytes"},
                              {"deep_opacity", "layers=7,resolution=2048"},
                              {"opacity_map", "slices=16,resolution=512"},
                              {"opacity_map", "slices=16,resolution=512,filter_texels=2"},
                              {"deep_shadow", "resolution=512"},
                              {"exact_list", "resolution=512"},
                              {"moments", "resolution=512"},
                              {"fourier", "resolution=512"},
                              {"voxel", "resolution=128"}};

registry::ParameterValues values_of(const Setting& setting) {
  return registry::parse_assignments((*shadows::find_method(setting.method))->entry.parameters, setting.set).value();
}

/// Milliseconds of a lookup at every vertex.
struct Lookup {
  double with = 1e30, without = 1e30;
};
void print(const char* where, const Setting& setting, const Lookup& lookup) {
  fmt::print("{:<7}{:<14}{:<44}{:9.2f} ms with, {:9.2f} without: {:.2f} times\n", where, setting.method, setting.set,
             lookup.with, lookup.without, lookup.with / lookup.without);
  std::fflush(stdout);
}

/// The strand of each vertex.
struct Named {
  std::vector<std::uint32_t> strands, vertices;
  explicit Named(const strands::Groom& groom) {
    for (std::uint32_t s = 0; s < groom.strand_count(); ++s)
      for (std::uint32_t v = groom.offsets[s]; v < groom.offsets[s + 1]; ++v) {
        strands.push_back(s);
        vertices.push_back(v);
      }
  }
};

Lookup on_cpu(const strands::Groom& groom, const Named& named, const Setting& setting) {
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  const shadows::Receivers own{groom.positions, named.strands, {}, named.vertices}, free{groom.positions};
  const auto lookup_ms = [&, values = values_of(setting)](const shadows::Receivers& receivers) {
    return (*shadows::find_method(setting.method))
        ->evaluate({&groom, k_alpha, {0.6, 0.8, 0}}, receivers, values)
        ->cost.lookup_ms;
  };
  Lookup lookup;
  for (int turn = 0; turn < k_turns; ++turn) {
    lookup.with = std::min(lookup.with, lookup_ms(own));
    lookup.without = std::min(lookup.without, lookup_ms(free));
  }
  return lookup;
}

#ifdef CUTICLE_HAS_GPU
/// The groom, then copies of its vertices that no segment joins.
struct Copies {
  gpu::Buffer vertices, transmittance;
  shadows::GpuStrands strands;
  Copies(gpu::Device& device, const strands::Groom& groom, const shadows::GroomOnDevice& once, int copies)
      : strands(once.strands) {
    std::vector<glm::vec4> packed;
    for (int copy = 0; copy <= copies; ++copy)
      for (std::size_t v = 0; v < groom.vertex_count(); ++v) packed.emplace_back(groom.positions[v], groom.radii[v]);
    vertices = gpu::make_buffer_from<glm::vec4>(device, packed).value();
    transmittance = device.make_buffer(4 * packed.size()).value();
    strands.vertices = &vertices;
    strands.vertex_count = std::uint32_t(packed.size());
  }
};

double lookup_ms(gpu::Device& device, shadows::GpuShadow& shadow, const Copies& copies) {
  gpu::Commands commands = device.record();
  const auto recorded = shadow.record(commands, copies.strands, k_alpha, {{0.6, 0.8, 0}}, copies.transmittance);
  CUTICLE_EXPECT(bool(recorded), "a distant light is taken by every method");
  return device.submit(std::move(commands))->passes.back().gpu_ms;
}

void on_device(const strands::Groom& groom) {
  const auto device = gpu::Device::open().value();
  const auto once = shadows::upload_groom(*device, groom).value();
  const Copies alone(*device, groom, *once, 0), two(*device, groom, *once, 1), three(*device, groom, *once, 2);
  fmt::print("{}\n", device->info().name);
  for (const Setting& setting : k_settings) {
    const auto shadow = (*shadows::find_gpu_method(setting.method))->create(device, values_of(setting));
    if (!shadow) {
      fmt::print("{} {}: {}\n", setting.method, setting.set, shadow.error().message);
      continue;
    }
    std::array<double, 3> least{1e30, 1e30, 1e30};
    for (int turn = 0; turn < k_turns; ++turn)
      for (int i = 0; const Copies* copies : {&alone, &two, &three}) {
        least[std::size_t(i)] = std::min(least[std::size_t(i)], lookup_ms(*device, **shadow, *copies));
        ++i;
      }
    print("device", setting, {least[0], 0.5 * (least[2] - least[0])});
  }
}
#endif

}  // namespace

int main(int count, char** arguments) {
  strands::Groom groom = study::study_coat(5000);
  if (count > 3) {
    strands::ReadOptions read;
    read.metres_per_unit = std::stod(arguments[2]);
    read.radius = std::stod(arguments[3]);
    groom = strands::read_groom(arguments[1], read)->groom;
  }
  fmt::print("{} strands, {} vertices\n", groom.strand_count(), groom.vertex_count());
  const Named named(groom);
  for (const Setting& setting : k_settings) print("cpu", setting, on_cpu(groom, named, setting));
#ifdef CUTICLE_HAS_GPU
  on_device(groom);
#endif
}
