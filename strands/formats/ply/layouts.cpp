#include <algorithm>
#include <numeric>

#include <fmt/core.h>

#include "strands/formats/ply/detail/layouts.h"

namespace cuticle::strands::ply {

namespace {

constexpr std::uint32_t k_none = 0xffffffffu;
constexpr std::size_t k_usual_points = 100;

Layout layout_of(std::vector<std::uint32_t> offsets, std::string found) {
  Layout layout{std::move(offsets), {}, std::move(found)};
  layout.rows.resize(layout.offsets.back());
  std::iota(layout.rows.begin(), layout.rows.end(), 0u);
  return layout;
}

Layout even_layout(std::size_t vertices, std::size_t points, std::string found) {
  std::vector<std::uint32_t> offsets{0};
  for (std::size_t end = points; end <= vertices; end += points) offsets.push_back(std::uint32_t(end));
  return layout_of(std::move(offsets), std::move(found));
}

Result<Layout> by_segments(const Property& segments, std::size_t vertices, const std::string& where) {
  std::vector<std::uint32_t> offsets{0};
  for (double count : segments.values) {
    const double end = double(offsets.back()) + count + 1;
    if (!(count >= 0 && end <= double(vertices)))
      return bad_input(fmt::format("{}: nsegs of strand {} is {}: its points would end at {} of {}", where,
                                   offsets.size() - 1, count, end, vertices));
    offsets.push_back(std::uint32_t(end));
  }
  if (offsets.back() != vertices)
    return bad_input(fmt::format("{}: nsegs add up to {} points of {}", where, offsets.back(), vertices));
  return layout_of(std::move(offsets), "element 'strand'");
}

/// next[v] and whether v is begun at; error where a vertex has two edges out or in.
Result<std::vector<std::uint32_t>> chain(const Property& from, const Property& to, std::size_t vertices,
                                         std::vector<bool>& is_entered, const std::string& where) {
  std::vector<std::uint32_t> next(vertices, k_none);
  for (std::size_t e = 0; e < from.values.size(); ++e) {
    const double a = from.values[e], b = to.values[e];
    if (!(a >= 0 && b >= 0 && a < double(vertices) && b < double(vertices)))
      return bad_input(
          fmt::format("{}: edge {}: vertices {} and {}, allowed 0 .. {}", where, e, a, b, double(vertices) - 1));
    const std::size_t begin = std::size_t(a), end = std::size_t(b);
    if (next[begin] != k_none || is_entered[end])
      return bad_input(fmt::format("{}: edge {} from {} to {}: strands meet or branch there", where, e, begin, end));
    next[begin] = std::uint32_t(end);
    is_entered[end] = true;
  }
  return next;
}

Result<Layout> by_edges(const Element& edge, std::size_t vertices, const std::string& where) {
  const Property *from = edge.find("vertex1"), *to = edge.find("vertex2");
  if (!from || !to) return bad_input(fmt::format("{}: element 'edge' has no vertex1 and vertex2", where));
  std::vector<bool> is_entered(vertices, false);
  CUTICLE_ASSIGN(const std::vector<std::uint32_t> next, chain(*from, *to, vertices, is_entered, where));
  Layout layout{{0}, {}, "chains of element 'edge'"};
  for (std::uint32_t root = 0; root < vertices; ++root) {
    if (is_entered[root]) continue;
    for (std::uint32_t v = root; v != k_none; v = next[v]) layout.rows.push_back(v);
    layout.offsets.push_back(std::uint32_t(layout.rows.size()));
  }
  if (layout.rows.size() == vertices) return layout;
  return bad_input(fmt::format("{}: edges form closed loops of {} vertices", where, vertices - layout.rows.size()));
}

/// Points to a strand where the colour changes every so many points and at no other; 0 where it does not.
std::size_t points_of_one_colour(const Element& vertex) {
  const Property* channels[] = {vertex.find("red"), vertex.find("green"), vertex.find("blue")};
  if (!channels[0] || !channels[1] || !channels[2]) return 0;
  const auto changes = [&](std::size_t v) {
    return std::any_of(std::begin(channels), std::end(channels),
                       [&](const Property* c) { return c->values[v] != c->values[v - 1]; });
  };
  std::size_t run = 1;
  while (run < vertex.rows && !changes(run)) ++run;
  if (run < 2 || run == vertex.rows || vertex.rows % run != 0) return 0;
  // Two strands may have the same colour by chance: a change may be missing, but none may lie elsewhere.
  for (std::size_t v = run; v < vertex.rows; ++v)
    if (v % run != 0 && changes(v)) return 0;
  return run;
}

}  // namespace

Result<Layout> find_layout(const Elements& elements, const std::string& where) {
  const Element* vertex = find(elements, "vertex");
  if (!vertex || vertex->rows == 0 || !vertex->find("x") || !vertex->find("y") || !vertex->find("z"))
    return bad_input(fmt::format("{}: no element 'vertex' with x, y and z", where));
  if (vertex->rows >= k_none)
    return bad_input(fmt::format("{}: {} points, allowed 2 .. {}", where, vertex->rows, k_none - 1));
  if (const Element* strand = find(elements, "strand"); strand && strand->find("nsegs"))
    return by_segments(*strand->find("nsegs"), vertex->rows, where);
  if (const Element* edge = find(elements, "edge"); edge && edge->rows > 0) return by_edges(*edge, vertex->rows, where);
  if (const std::size_t points = points_of_one_colour(*vertex))
    return even_layout(vertex->rows, points, fmt::format("a cloud of {} points of one colour each", points));
  if (vertex->rows % k_usual_points == 0)
    return even_layout(vertex->rows, k_usual_points, fmt::format("a cloud of {} points each", k_usual_points));
  return bad_input(
      fmt::format(
          "{}: {} points without strands: no element 'strand' or 'edge', no even change of colour, no multiple of {}",
          where, vertex->rows, k_usual_points),
      "save the strands as an array of strands x points x 3 (.npz) instead");
}

}  // namespace cuticle::strands::ply
