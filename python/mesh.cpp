#include "python/mesh.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace cuticle::python {

strands::Mesh mesh_of(const Floats& positions, const Indices& triangles) {
  strands::Mesh mesh;
  mesh.positions = rows_of<glm::vec3>(positions, "positions");
  mesh.triangles = rows_of<std::array<std::uint32_t, 3>>(triangles, "triangles");
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (!std::isfinite(positions.data()[i])) raise(bad_input(fmt::format("positions: vertex {} is not finite", i / 3)));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (const auto worst = std::ranges::max(mesh.triangles[t]); worst >= mesh.positions.size())
      raise(bad_input(fmt::format("triangles: triangle {} has the corner {}, outside 0 .. {}", t, worst,
                                  std::int64_t(mesh.positions.size()) - 1)));
  strands::compute_normals(mesh);
  return mesh;
}

namespace {

template <class T, class Item>
nb::object copied(const std::vector<Item>& items) {
  constexpr std::size_t components = sizeof(Item) / sizeof(T);
  const T* first = reinterpret_cast<const T*>(items.data());
  return nb::cast(take(std::vector<T>(first, first + components * items.size()), {items.size(), components}));
}

}  // namespace

nb::tuple arrays_of(const strands::Mesh& mesh) {
  return nb::make_tuple(copied<float>(mesh.positions), copied<std::uint32_t>(mesh.triangles),
                        copied<float>(mesh.normals));
}

}  // namespace cuticle::python
