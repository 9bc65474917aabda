#pragma once
// An order of strands in which each prefix is spread evenly over all: what a level of detail draws.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "strands/groom.h"

namespace cuticle::strands {

/// Points of a strand by which two are near each other: its root, two between, its tip. Finite.
using StrandShape = std::array<glm::vec3, 4>;

/// Of each strand; strands have a vertex or more.
std::vector<StrandShape> shapes_of(const Groom& groom);

/// 0 .. count - 1. A tree halves the strands by the coordinate of their shapes that varies most; of 2^n strands each
/// prefix of 2^k has one in each of the tree's 2^k parts, by chance any of it, so that no prefix leans to what is
/// usual. Ours. The same shapes give the same order.
std::vector<std::uint32_t> spread_order(std::span<const StrandShape> shapes);

}  // namespace cuticle::strands
