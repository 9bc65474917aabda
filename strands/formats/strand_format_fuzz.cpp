// Any bytes: an error or a valid groom, which survives writing and reading; damage that is kept can be mended. The
// program's name chooses the format: ply_fuzz, npz_fuzz, ..; any other: the bones of TressFX.
#include <cstdlib>
#include <filesystem>

#include "core/file.h"
#include "strands/formats/format.h"
#include "strands/formats/tfx/bones.h"
#include "strands/repair.h"

using namespace cuticle::strands;

namespace {

const Format* chosen = nullptr;

void require(bool holds) {
  if (!holds) std::abort();
}

void check_mending(std::span<const std::byte> bytes) {
  auto damaged = chosen->parse(bytes, "fuzz", Damage::keep);
  if (!damaged) return;
  repair(damaged->groom);
  require(bool(validate(damaged->groom)));
}

void check_round_trip(Groom groom) {
  drop_what_it_cannot_hold(groom, *chosen);
  const auto written = chosen->format(groom, 1);
  require(bool(written));
  const auto again = chosen->parse(*written, "again", Damage::refuse);
  require(again && again->groom.positions == groom.positions && again->groom.offsets == groom.offsets);
}

/// Two strands with a root uv and an attribute: headers and check sums are not found by chance.
std::vector<std::byte> seed() {
  Groom groom;
  groom.positions = {{0, 0, 0}, {0, 1, 0}, {0, 2, 1}, {1, 0, 0}, {1, 1, 0}, {1, 2, 1}};
  groom.offsets = {0, 3, 6};
  groom.radii = {1, 1, 0.5f, 1, 1, 0.5f};
  groom.root_uv = {{0, 0.5f}, {1, 0.5f}};
  groom.attributes["heat"] = {Attribute::Domain::strand, 2, {1, 2, 3, 4}};
  drop_what_it_cannot_hold(groom, *chosen);
  return chosen->format(groom, 1).value();
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  const std::string program = std::filesystem::path((*arguments)[0]).filename().string();
  for (const Format* format : formats())
    if (program == std::string(format->name) + "_fuzz") chosen = format;
  // Into the corpus that may grow, which is the first folder; of one folder alone nothing is to grow.
  std::vector<std::string> folders;
  for (int i = 1; i < *count; ++i)
    if (std::filesystem::is_directory((*arguments)[i])) folders.emplace_back((*arguments)[i]);
  if (chosen && folders.size() > 1) require(bool(cuticle::write_file(folders[0] + "/seed", seed())));
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto bytes = std::as_bytes(std::span(data, size));
  if (!chosen) {
    if (const auto weights = parse_tfxbone(bytes, "fuzz")) require(weights->index.size() == weights->weight.size());
    return 0;
  }
  check_mending(bytes);
  const auto parsed = chosen->parse(bytes, "fuzz", Damage::refuse);
  if (!parsed) return 0;
  require(validate(parsed->groom) && parsed->groom.strand_count() > 0);
  if (check_sizes(parsed->groom, *chosen)) check_round_trip(parsed->groom);
  return 0;
}
