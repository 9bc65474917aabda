// Any bytes as a scene file: an error or a scene, never a crash.
#include <cstddef>
#include <cstdint>

#include "scene/scene.h"

namespace {

using cuticle::registry::Entry;
using cuticle::registry::Parameter;
using cuticle::registry::ParameterType;

const Parameter k_parameters[] = {
    {.name = "eta", .minimum = 1.0, .maximum = 3.0, .default_text = "1.55"},
    {.name = "sigma_a", .type = ParameterType::rgb, .minimum = 0, .maximum = 100, .default_text = "0.2"}};
const Entry k_entry{.name = "known", .parameters = k_parameters};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const cuticle::scene::Catalogue catalogue{{&k_entry}, {&k_entry}, {&k_entry},
                                                   {&k_entry}, {&k_entry}, {&k_entry}};
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  (void)cuticle::scene::parse_scene(text, "/", "fuzz", catalogue).ok();
  return 0;
}
