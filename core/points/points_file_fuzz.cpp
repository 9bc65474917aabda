#include <cstddef>
#include <cstdint>

#include "core/points/points_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr cuticle::PointColumn columns[] = {{"theta_i", -90, 90, "deg"}, {"phi", -360, 360, "deg"}};
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto table = cuticle::parse_points(text, "fuzz.csv", columns);
  if (!table) return 0;
  for (const auto& row : table->rows)
    if (row.size() != table->columns.size()) __builtin_trap();
  return 0;
}
