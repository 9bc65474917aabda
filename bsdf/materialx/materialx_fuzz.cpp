#include <cstddef>
#include <cstdint>

#include "bsdf/materialx/materialx.h"
#include "bsdf/model.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto mapping = cuticle::bsdf::parse_materialx(text, "fuzz.mtlx");
  if (!mapping) return 0;
  if (!cuticle::bsdf::parse_settings(**cuticle::bsdf::find_model("chiang"), "", mapping->settings)) __builtin_trap();
  return 0;
}
