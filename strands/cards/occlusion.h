#pragma once
// A3: ambient occlusion of points within hair.
#include <span>
#include <vector>

#include "strands/groom.h"
#include "strands/mesh.h"

namespace cuticle::strands {

/// Share (0 .. 1, 1: open) of an even sky that reaches points with these unit normals: the mean over `rays` directions,
/// as many as there is cosine to the normal, of exp(-tau) through the groom's fibres, gathered in cells of 1/64 of its
/// longest side; a head's triangles, where given, stop a ray that is two cells on its way. tau counts a fibre by its
/// mean shadow, pi / 4 of its width. Within 0.015 of the closed form for a slab, 2 E3(tau) (cards_test). `groom` is
/// valid.
std::vector<float> ambient_occlusion(const Groom& groom, const Mesh* head, std::span<const glm::vec3> points,
                                     std::span<const glm::vec3> normals, int rays);

}  // namespace cuticle::strands
