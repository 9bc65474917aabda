// The first byte chooses the format.
#include <cmath>
#include <cstdint>

#include "bsdf/measured/measured.h"

namespace {

cuticle::Result<cuticle::bsdf::MeasuredFibre> parsed(std::uint8_t format, std::span<const std::byte> bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (format % 3 == 0) return cuticle::bsdf::parse_gantry(text, "fuzz.txt", {});
  if (format % 3 == 1) return cuticle::bsdf::parse_measured_csv(text, "fuzz.csv");
  return cuticle::bsdf::parse_slices(bytes, "fuzz.bin");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto fibre = parsed(data[0], {reinterpret_cast<const std::byte*>(data) + 1, size - 1});
  if (!fibre) return 0;
  if (fibre->directions.empty()) __builtin_trap();
  for (const auto& at : fibre->directions)
    if (!std::isfinite(at.theta_i + at.theta_o + at.phi + at.value.x + at.value.y + at.value.z)) __builtin_trap();
  return 0;
}
