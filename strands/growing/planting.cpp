// N1, N6: a control hair on every scalp vertex, grown by small steps along the normal, then the combed flow over the
// head.
#include <cuticle/strands/growing/growing.h>

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <cuticle/strands/growing/random.h>
#include <cuticle/strands/growing/surface.h>

namespace cuticle::strands {

namespace {

using registry::Parameter;
using registry::ParameterType;

constexpr Parameter k_parameters[] = {
    {"control_vertices", ParameterType::integer, "1", 2, 64, "7", {}, "Vertices of a control hair"},
    {"length", ParameterType::real, "m", 0.001, 2, "0.27", {}, "Length of a hair"},
    {"length_variation", ParameterType::real, "1", 0, 0.9, "0.12", {}, "Part of the length that chance may take away"},
    {"segment_growth",
     ParameterType::real,
     "1",
     1,
     3,
     "1.25",
     {},
     "Length of a segment over the one before it, root to tip"},
    {"parting", ParameterType::real, "1", 0, 1, "0.8", {}, "Combed straight back (0) or apart from the middle (1)"},
    {"comb",
     ParameterType::real,
     "1",
     0,
     1,
     "1",
     {},
     "How far hair near the head follows the comb; 0 leaves it on the normal"},
    {"droop", ParameterType::real, "1", 0, 1, "1", {}, "How far hair bends to the ground; 0 leaves it stiff"},
    {"volume", ParameterType::real, "m", 0.005, 0.1, "0.012", {}, "Height over the scalp at which combed hair lies"},
    {"fringe", ParameterType::real, "1", 0.05, 1, "1", {}, "Length at the front hairline over length elsewhere"},
    {"clump", ParameterType::real, "1", 0, 1, "0.25", {}, "How far tips gather to those of chosen neighbours"},
    {"radius", ParameterType::real, "m", 5e-6, 1e-3, "3.5e-5", {}, "Fibre radius"},
    {"seed", ParameterType::integer, "1", 0, 4294967295.0, "1", {}, "Seed of all chance"},
};

/// The parameters as numbers.
struct Style {
  explicit Style(const registry::ParameterValues& values)
      : vertices(int(values.integer("control_vertices"))),
        length(values.real("length")),
        variation(values.real("length_variation")),
        growth(values.real("segment_growth")),
        parting(values.real("parting")),
        comb(values.real("comb")),
        droop(values.real("droop")),
        volume(values.real("volume")),
        fringe(values.real("fringe")),
        clump(values.real("clump")),
        radius(values.real("radius")),
        seed(std::uint64_t(values.integer("seed"))) {}
  int vertices;
  double length, variation, growth, parting, comb, droop, volume, fringe, clump, radius;
  std::uint64_t seed;
};

/// Head coordinates: about the middle of the scalp, in units of its width (1 unit = 0.15 m on an adult head).
struct HeadFrame {
  glm::dvec3 center{0};
  double unit = 1;
  glm::dvec3 place(const glm::dvec3& point) const { return (point - center) / unit; }
};
HeadFrame head_frame(const Mesh& scalp) {
  glm::dvec3 lower(scalp.positions.front()), upper = lower;
  for (const glm::vec3& position : scalp.positions) {
    lower = glm::min(lower, glm::dvec3(position));
    upper = glm::max(upper, glm::dvec3(position));
  }
  HeadFrame frame;
  frame.unit = std::max(upper.x - lower.x, 1e-6);
  frame.center = {0.5 * (lower.x + upper.x), upper.y - 0.55 * frame.unit, 0.5 * (lower.z + upper.z)};
  return frame;
}

/// +1 or -1 per scalp vertex: the side of the middle plane that its triangles lie on (both copies on the parting
/// differ).
std::vector<double> sides(const Mesh& scalp, const HeadFrame& frame) {
  std::vector<double> sums(scalp.positions.size(), 0);
  for (const auto& triangle : scalp.triangles) {
    double middle = 0;
    for (std::uint32_t corner : triangle) middle += frame.place(scalp.positions[corner]).x;
    for (std::uint32_t corner : triangle) sums[corner] += middle;
  }
  for (double& side : sums) side = side < 0 ? -1 : 1;
  return sums;
}

/// Where the comb pulls at a place of the head: apart and back on the top, down and back at the sides.
glm::dvec3 comb_direction(const glm::dvec3& place, double side, double parting) {
  const double top = glm::smoothstep(0.0, 0.42, place.y);
  const double part = parting * glm::smoothstep(-0.3, 0.2, place.z);
  const double back_at_side = 0.9 * glm::smoothstep(0.02, 0.45, place.z);
  const glm::dvec3 over_top(side * part, -0.1, -0.35 - 0.9 * (1 - part));
  const glm::dvec3 at_side(0, -1, -back_at_side);
  return glm::mix(at_side, over_top, top);
}

class Grower {
 public:
  Grower(const Head& head, const Style& style)
      : head_(head),
        style_(style),
        frame_(head_frame(head.scalp)),
        sides_(sides(head.scalp, frame_)),
        surface_(head.mesh, 0.05 * frame_.unit / 0.15) {}

  double length_of(std::size_t vertex) const {
    const glm::dvec3 place = frame_.place(head_.scalp.positions[vertex]);
    const double front = glm::smoothstep(0.3, 0.5, place.z);
    const double chance = 1 - style_.variation * random_stream(style_.seed, Chance::length, vertex).next_unit();
    return style_.length * chance * glm::mix(1.0, style_.fringe, front);
  }

  /// A fine path along which the control vertices are then placed; longer than the hair, since chords are shorter than
  /// arcs.
  std::vector<glm::dvec3> path(std::size_t vertex, double length) const {
    constexpr int steps = 100;
    const double step = 1.3 * length / steps;
    glm::dvec3 point(head_.scalp.positions[vertex]), direction(head_.scalp.normals[vertex]);
    std::vector<glm::dvec3> points{point};
    for (int i = 0; i < steps; ++i) {
      direction = turned(point, direction, sides_[vertex], i * step, step);
      point = outside(point + direction * step, i * step);
      points.push_back(point);
    }
    return points;
  }

  /// Moves a point out of the head and its colliders. `travelled`: arc length from the root, metres.
  glm::dvec3 outside(glm::dvec3 point, double travelled) const {
    const double clearance = std::min(k_clearance, 0.5 * travelled);
    const SurfaceHit hit = surface_.at(point);
    if (hit.distance < clearance) point += hit.normal * (clearance - hit.distance);
    for (const Sphere& sphere : head_.colliders) {
      const glm::dvec3 offset = point - sphere.center;
      const double distance = glm::length(offset);
      if (distance > 0 && distance < sphere.radius) point = sphere.center + offset * (sphere.radius / distance);
    }
    return point;
  }

 private:
  static constexpr double k_clearance = 0.003;  ///< metres
  static constexpr double k_stiffness = 0.009;  ///< length over which hair turns to where it is pulled, metres

  glm::dvec3 turned(const glm::dvec3& point, const glm::dvec3& direction, double side, double travelled,
                    double step) const {
    const SurfaceHit hit = surface_.at(point);
    // Hair that has travelled far lies over hair that has not.
    const double height = style_.volume * (0.5 + std::min(travelled / 0.15, 1.0));
    // Under jaw, ears and neck hair hangs free.
    const double near =
        (1 - glm::smoothstep(0.012, 0.04, hit.distance - height)) * glm::smoothstep(-0.7, -0.3, hit.normal.y);
    const auto along_head = [&](const glm::dvec3& v) { return v - near * hit.normal * glm::dot(v, hit.normal); };
    const glm::dvec3 combed = near * along_head(comb_direction(frame_.place(point), side, style_.parting));
    const glm::dvec3 lifted = near * hit.normal * glm::clamp((height - hit.distance) / 0.01, -0.7, 1.0);
    const glm::dvec3 pull = style_.comb * (combed + lifted) + style_.droop * 0.8 * along_head(glm::dvec3(0, -1, 0));
    const double turn = (1 - std::exp(-step / k_stiffness)) * std::min(glm::length(pull), 1.0);
    const glm::dvec3 mixed = (1 - turn) * direction + turn * glm::normalize(pull + 1e-9 * direction);
    return glm::length(mixed) > 1e-6 ? glm::normalize(mixed) : direction;
  }

  const Head& head_;
  const Style& style_;
  HeadFrame frame_;
  std::vector<double> sides_;
  NearestSurface surface_;
};

/// N6: lengths of the segments, each `growth` times the one before, summing to `length`.
std::vector<double> segment_lengths(double length, int segments, double growth) {
  std::vector<double> lengths(std::size_t(segments), 1);
  double sum = 0;
  for (std::size_t i = 0; i < lengths.size(); ++i) sum += lengths[i] = std::pow(growth, double(i));
  for (double& segment : lengths) segment *= length / sum;
  return lengths;
}

/// The first point on the path after `at` that lies `distance` from `from`; moves `at` to its place (index + fraction).
glm::dvec3 next_on_path(const std::vector<glm::dvec3>& path, std::size_t& at, const glm::dvec3& from, double distance) {
  while (at + 1 < path.size() && glm::distance(path[at + 1], from) < distance) ++at;
  if (at + 1 >= path.size()) return from + glm::normalize(path.back() - from + glm::dvec3(0, -1e-12, 0)) * distance;
  glm::dvec3 inside = path[at], beyond = path[at + 1];
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 middle = 0.5 * (inside + beyond);
    (glm::distance(middle, from) < distance ? inside : beyond) = middle;
  }
  return beyond;
}

std::vector<glm::dvec3> place_vertices(const std::vector<glm::dvec3>& path, const std::vector<double>& lengths) {
  std::vector<glm::dvec3> hair{path.front()};
  std::size_t at = 0;
  for (double length : lengths) hair.push_back(next_on_path(path, at, hair.back(), length));
  return hair;
}

/// Sets every segment to its length again, root first, keeping directions; vertices stay outside the head.
void restore_lengths(std::vector<glm::dvec3>& hair, const std::vector<double>& lengths, const Grower& grower) {
  for (std::size_t i = 1; i < hair.size(); ++i) {
    for (int pass = 0; pass < 10; ++pass) {
      if (i > 1) hair[i] = grower.outside(hair[i], 1);
      const glm::dvec3 segment = hair[i] - hair[i - 1];
      hair[i] = hair[i - 1] + segment * (lengths[i - 1] / std::max(glm::length(segment), 1e-12));
    }
  }
}

using Hairs = std::vector<std::vector<glm::dvec3>>;

/// About one hair in eight leads; the tips of others move to the nearest leader's.
Hairs clumped(const Hairs& hairs, const Style& style) {
  std::vector<std::size_t> leaders;
  for (std::size_t h = 0; h < hairs.size(); ++h)
    if (random_stream(style.seed, Chance::clump, h).next_unit() < 0.125) leaders.push_back(h);
  Hairs result = hairs;
  if (leaders.empty() || style.clump == 0) return result;
  for (std::size_t h = 0; h < hairs.size(); ++h) {
    const auto gap = [&](std::size_t leader) {
      return glm::distance(hairs[h].front(), hairs[leader].front()) +
             glm::distance(hairs[h].back(), hairs[leader].back());
    };
    const std::size_t leader = *std::min_element(leaders.begin(), leaders.end(),
                                                 [&](std::size_t a, std::size_t b) { return gap(a) < gap(b); });
    for (std::size_t i = 0; i < hairs[h].size(); ++i) {
      const double tip = double(i) / double(hairs[h].size() - 1);
      result[h][i] += style.clump * tip * tip * (hairs[leader][i] - hairs[h][i]);
    }
  }
  return result;
}

Result<void> check_head(const Head& head) {
  if (head.scalp.positions.empty()) return bad_input("head: the scalp has no vertices, at least 1 is needed");
  if (head.scalp.normals.size() != head.scalp.positions.size())
    return bad_input(fmt::format("head: the scalp has {} normals for {} vertices", head.scalp.normals.size(),
                                 head.scalp.positions.size()));
  if (head.mesh.normals.size() != head.mesh.positions.size())
    return bad_input(fmt::format("head: the mesh has {} normals for {} vertices", head.mesh.normals.size(),
                                 head.mesh.positions.size()));
  return {};
}

Groom to_groom(const Hairs& hairs, const Mesh& scalp, double radius) {
  Groom groom;
  for (const std::vector<glm::dvec3>& hair : hairs) {
    for (const glm::dvec3& point : hair) groom.positions.emplace_back(point);
    groom.offsets.push_back(std::uint32_t(groom.positions.size()));
  }
  groom.radii.assign(groom.positions.size(), float(radius));
  groom.root_uv = scalp.uv;
  return groom;
}

}  // namespace

registry::ParameterTable growing_parameters() { return k_parameters; }

Result<Groom> plant_control_hairs(const Head& head, const registry::ParameterValues& growing) {
  CUTICLE_TRY(check_head(head));
  const Style style(growing);
  const Grower grower(head, style);
  Hairs hairs(head.scalp.positions.size());
  std::vector<std::vector<double>> lengths(hairs.size());
  for (std::size_t v = 0; v < hairs.size(); ++v) {
    const double length = grower.length_of(v);
    lengths[v] = segment_lengths(length, style.vertices - 1, style.growth);
    hairs[v] = place_vertices(grower.path(v, length), lengths[v]);
  }
  hairs = clumped(hairs, style);
  for (std::size_t v = 0; v < hairs.size(); ++v) restore_lengths(hairs[v], lengths[v], grower);
  return to_groom(hairs, head.scalp, style.radius);
}

}  // namespace cuticle::strands
