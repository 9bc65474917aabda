#pragma once
#include "render/pass.h"
#include "render/resource.h"

namespace cuticle::render::surface_shadow {

struct Parameters {
  static constexpr std::string_view name = "surface_shadow";
  int resolution = 1024;
  double bias = 4e-3;  ///< metres
  float strand_filter = 1, surface_filter = 3;
  double hair_share = 1;
  bool wanted = true;  ///< false: not even in a scene with a shadow method
};
void describe(registry::Members& members, Parameters& parameters);

/// Texels of the lights' maps side by side.
glm::ivec2 texture_size(int resolution, int lights);

/// Bands of rows, in each of which hair is drawn by one dispatch, begin at multiples of so many rows.
constexpr std::uint32_t k_rows_of_a_part = 64;
/// How many bands there are: each is no larger than one binding of a storage buffer. Counted for three opacities, whose
/// maps lie one below the other.
std::uint32_t hair_bands(int resolution, int lights, std::uint64_t max_storage_buffer_bytes);

/// What surfaces and hair cast on each other.
struct Maps;
constexpr std::string_view resource_name(const Maps*) { return "surface_shadow"; }

/// The registry's entry of the pass.
const Pass& entry();

}  // namespace cuticle::render::surface_shadow
