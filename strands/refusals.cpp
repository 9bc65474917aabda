#include "strands/refusals.h"

#include <algorithm>
#include <bit>

#include <fmt/core.h>

namespace cuticle::strands {

namespace {

struct Sizes {
  std::size_t least, greatest;
};
Sizes sizes_of(const Groom& groom) {
  Sizes sizes{groom.vertex_count(), 0};
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    sizes.least = std::min(sizes.least, groom.strand_size(s));
    sizes.greatest = std::max(sizes.greatest, groom.strand_size(s));
  }
  return sizes;
}

std::size_t strands_without_length(const Groom& groom) {
  std::size_t count = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) count += strand_length(groom, s) == 0;
  return count;
}

void add(std::vector<Refusal>& list, const char* engine, const char* what, std::size_t found, std::size_t least,
         std::size_t most) {
  if (found < least || found > most)
    list.push_back({engine, fmt::format("{} {}, allowed {} .. {}", what, found, least, most)});
}

void add_unreal(std::vector<Refusal>& list, const Groom& groom, const Sizes& sizes) {
  add(list, "unreal", "points of a strand", sizes.greatest, 2, 255);
  add(list, "unreal", "strands of a group", groom.strand_count(), 1, 4194303);
  add(list, "unreal", "points of a group", groom.vertex_count(), 2, 16777215);
  add(list, "unreal", "strands without length", strands_without_length(groom), 0, 0);
}

void add_tressfx(std::vector<Refusal>& list, const Sizes& sizes) {
  if (sizes.least != sizes.greatest)
    list.push_back(
        {"tressfx", fmt::format("strands of {} .. {} points, all must have one number", sizes.least, sizes.greatest)});
  else if (!std::has_single_bit(sizes.greatest) || sizes.greatest < 4 || sizes.greatest > 64)
    list.push_back({"tressfx", fmt::format("strands of {} points, allowed 4, 8, 16, 32, 64", sizes.greatest)});
}

}  // namespace

std::vector<Refusal> refusals(const Groom& groom) {
  const Sizes sizes = sizes_of(groom);
  std::vector<Refusal> list;
  add_unreal(list, groom, sizes);
  add(list, "unity", "strands", groom.strand_count(), 64, 64000);
  add(list, "unity", "least points of a strand", sizes.least, 3, 128);
  if (sizes.greatest > 128) add(list, "unity", "points of a strand", sizes.greatest, 3, 128);
  add_tressfx(list, sizes);
  return list;
}

std::vector<Refusal> missing(const Groom& groom) {
  std::vector<Refusal> list;
  if (groom.root_uv.empty()) list.push_back({"unreal", "no root UV: it finds roots on the skin by distance"});
  return list;
}

}  // namespace cuticle::strands
