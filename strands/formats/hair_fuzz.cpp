// Any bytes: an error or a valid groom, which survives writing and reading.
#include <cstdlib>

#include <cuticle/strands/formats/formats.h>

using namespace cuticle::strands;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto groom = parse_hair(std::as_bytes(std::span(data, size)), "fuzz");
  if (!groom) return 0;
  if (!validate(*groom) || groom->strand_count() == 0) std::abort();
  const auto again = parse_hair(format_hair(*groom), "again");
  if (!again || again->positions != groom->positions || again->offsets != groom->offsets) std::abort();
  return 0;
}
