// Strand sets as NumPy archives (.npz): strands x points x 3, or offsets and points.
#include <algorithm>

#include <fmt/core.h>

#include "strands/finite.h"
#include "strands/formats/bytes.h"
#include "strands/formats/npz/detail/archive.h"
#include "strands/formats/npz/detail/arrays.h"

namespace cuticle::strands::npz {

namespace {

constexpr std::string_view k_strand = "strand_", k_vertex = "vertex_";

class Builder {
 public:
  Builder(std::vector<Array>& arrays, const std::string& where, Damage damage)
      : arrays_(arrays), where_(where), damage_(damage) {}

  Result<ParsedGroom> build() {
    CUTICLE_TRY(read_points());
    CUTICLE_TRY(check_sizes_and_numbers());
    const std::size_t strands = groom().strand_count(), vertices = groom().vertex_count();
    CUTICLE_TRY(read_floats("radii", vertices, 1, groom().radii));
    if (groom().radii.empty()) groom().radii.assign(vertices, 0.0f);
    CUTICLE_TRY(read_floats("root_uv", strands, 2, groom().root_uv));
    CUTICLE_TRY(read_floats("root_barycentrics", strands, 2, groom().root_barycentrics));
    if (Array* triangles = take("root_triangle")) {
      if (triangles->whole.size() != strands) return shape_error(*triangles, strands, 1);
      groom().root_triangle = std::move(triangles->whole);
    }
    CUTICLE_TRY(read_attributes(k_strand, Attribute::Domain::strand, strands));
    CUTICLE_TRY(read_attributes(k_vertex, Attribute::Domain::vertex, vertices));
    say_what_is_left_out();
    return std::move(parsed_);
  }

 private:
  Groom& groom() { return parsed_.groom; }

  Array* take(std::string_view name) {
    for (Array& array : arrays_)
      if (array.name == name && array.problem.empty()) {
        used_.push_back(&array);
        return &array;
      }
    return nullptr;
  }

  Error shape_error(const Array& array, std::size_t rows, std::size_t components) const {
    return bad_input(fmt::format("{}: array '{}' has {} numbers of a fitting type, {} x {} are needed", where_,
                                 array.name, array.count(), rows, components));
  }

  static bool is_strands(const Array& array) {
    return array.shape.size() == 3 && array.shape[2] == 3 && !array.values.empty();
  }

  Result<void> read_points() {
    Array* positions = take("positions");
    if (Array* offsets = take("offsets"); offsets && positions) return read_by_offsets(*offsets, *positions);
    if (!positions) positions = take("strands");
    for (Array& array : arrays_)
      if (!positions && is_strands(array)) positions = take(array.name);
    if (!positions || !is_strands(*positions)) return no_strands();
    const std::uint64_t strands = positions->shape[0], points = positions->shape[1];
    if (strands * points > 0xffffffffull)
      return bad_input(fmt::format("{}: {} points, allowed 2 .. {}", where_, strands * points, 0xffffffffull));
    for (std::uint64_t s = 1; s <= strands; ++s) groom().offsets.push_back(std::uint32_t(s * points));
    parsed_.notes.push_back(
        fmt::format("strands found in the array '{}': {} x {} x 3", positions->name, strands, points));
    return copy_positions(*positions);
  }

  Error no_strands() const {
    std::string list;
    for (const Array& array : arrays_)
      list += array.problem.empty() ? fmt::format(" '{}' of {} axes;", array.name, array.shape.size())
                                    : " " + array.problem + ";";
    return bad_input(fmt::format(
        "{}: no array of numbers strands x points x 3 and no 'offsets' with 'positions'; it holds:{}", where_, list));
  }

  Result<void> read_by_offsets(const Array& offsets, const Array& positions) {
    const std::vector<std::uint32_t>& ends = offsets.whole;
    if (ends.empty() || ends.front() != 0 || !std::is_sorted(ends.begin(), ends.end()) ||
        positions.values.size() != 3 * std::uint64_t(ends.back()))
      return bad_input(fmt::format("{}: 'offsets' must rise from 0 to the number of 'positions', {}", where_,
                                   positions.values.size() / 3));
    groom().offsets = ends;
    return copy_positions(positions);
  }

  Result<void> copy_positions(const Array& array) {
    groom().positions.resize(array.values.size() / 3);
    std::copy(array.values.begin(), array.values.end(), reinterpret_cast<float*>(groom().positions.data()));
    return {};
  }

  Result<void> check_sizes_and_numbers() {
    if (groom().strand_count() == 0 || groom().vertex_count() == 0)
      return bad_input(fmt::format("{}: 0 strands or points, at least 1 is needed", where_));
    if (damage_ == Damage::keep) return {};
    for (std::size_t s = 0; s < groom().strand_count(); ++s)
      if (groom().strand_size(s) < 2)
        return bad_input(
            fmt::format("{}: strand {} has {} points, at least 2 are needed", where_, s, groom().strand_size(s)),
            "--repair takes such strands out");
    const std::size_t bad = first_not_finite({&groom().positions.front().x, 3 * groom().vertex_count()});
    if (bad < 3 * groom().vertex_count()) return bad_input(fmt::format("{}: point {} is not finite", where_, bad / 3));
    return {};
  }

  /// An array of rows x components floats into `items`, where the file has one.
  template <class T>
  Result<void> read_floats(const char* name, std::size_t rows, std::size_t components, std::vector<T>& items) {
    Array* array = take(name);
    if (!array) return {};
    if (array->values.size() != rows * components) return shape_error(*array, rows, components);
    CUTICLE_TRY(require_numbers(*array, std::string_view(name) == "radii"));
    items.resize(rows);
    std::copy(array->values.begin(), array->values.end(), reinterpret_cast<float*>(items.data()));
    return {};
  }

  Result<void> require_numbers(const Array& array, bool is_positive) const {
    if (damage_ == Damage::keep) return {};
    std::size_t bad = first_not_finite(array.values);
    if (is_positive && bad == array.values.size())
      bad = std::size_t(std::find_if(array.values.begin(), array.values.end(), [](float v) { return v < 0; }) -
                        array.values.begin());
    if (bad == array.values.size()) return {};
    return bad_input(fmt::format("{}: '{}'[{}] is {}, must be finite{}", where_, array.name, bad,
                                 double(array.values[bad]), is_positive ? " and at least 0" : ""));
  }

  Result<void> read_attributes(std::string_view prefix, Attribute::Domain domain, std::size_t rows) {
    for (Array& array : arrays_) {
      if (!array.name.starts_with(prefix) || array.values.empty()) continue;
      take(array.name);
      if (array.values.size() % rows != 0)
        return shape_error(array, rows, std::size_t(std::max<std::uint64_t>(1, array.extent(1))));
      CUTICLE_TRY(require_numbers(array, false));
      groom().attributes[array.name.substr(prefix.size())] = {domain, int(array.values.size() / rows),
                                                              std::move(array.values)};
    }
    return {};
  }

  void say_what_is_left_out() {
    std::string names;
    for (const Array& array : arrays_)
      if (std::find(used_.begin(), used_.end(), &array) == used_.end()) names += " " + array.name;
    if (!names.empty()) parsed_.notes.push_back("arrays left out:" + names);
  }

  std::vector<Array>& arrays_;
  const std::string& where_;
  Damage damage_;
  ParsedGroom parsed_;
  std::vector<const Array*> used_;
};

Result<std::vector<Array>> parse_arrays(std::span<const std::byte> bytes, const std::string& where) {
  std::vector<Array> arrays;
  if (to_text(bytes).starts_with("\x93NUMPY")) {
    const std::string name = "strands";
    CUTICLE_ASSIGN(Array only, parse_npy(bytes, name, where));
    arrays.push_back(std::move(only));
    return arrays;
  }
  CUTICLE_ASSIGN(const std::vector<Member> members, read_archive(bytes, where));
  for (const Member& member : members) {
    const std::string name =
        member.name.ends_with(".npy") ? member.name.substr(0, member.name.size() - 4) : member.name;
    Result<Array> array = parse_npy(member.bytes, name, where);
    arrays.push_back(array ? std::move(*array) : Array{.name = name, .problem = array.error().message});
  }
  return arrays;
}

Result<ParsedGroom> parse(std::span<const std::byte> bytes, const std::string& where, Damage damage) {
  CUTICLE_ASSIGN(std::vector<Array> arrays, parse_arrays(bytes, where));
  return Builder(arrays, where, damage).build();
}

void add_floats(std::vector<Member>& members, const std::string& name, const float* values, std::size_t rows,
                std::size_t components) {
  const std::uint64_t shape[] = {rows, components};
  if (rows > 0)
    members.push_back(
        {name + ".npy", format_npy({values, rows * components}, std::span(shape).first(components == 1 ? 1 : 2))});
}

Result<std::vector<std::byte>> format_npz(const Groom& groom, double) {
  std::vector<Member> members{{"offsets.npy", format_npy(groom.offsets)}};
  const auto pairs = [&](const char* name, const std::vector<glm::vec2>& values) {
    add_floats(members, name, reinterpret_cast<const float*>(values.data()), values.size(), 2);
  };
  add_floats(members, "positions", reinterpret_cast<const float*>(groom.positions.data()), groom.vertex_count(), 3);
  add_floats(members, "radii", groom.radii.data(), groom.vertex_count(), 1);
  pairs("root_uv", groom.root_uv);
  pairs("root_barycentrics", groom.root_barycentrics);
  if (!groom.root_triangle.empty()) members.push_back({"root_triangle.npy", format_npy(groom.root_triangle)});
  for (const auto& [name, attribute] : groom.attributes) {
    const std::size_t components = std::size_t(attribute.components);
    const std::string_view prefix = attribute.domain == Attribute::Domain::strand ? k_strand : k_vertex;
    add_floats(members, std::string(prefix) + name, attribute.values.data(), attribute.values.size() / components,
               components);
  }
  return write_archive(members);
}

constexpr std::string_view k_extensions[] = {"npz"}, k_read_only[] = {"npy"};

}  // namespace

const Format& entry() {
  static const Format format{.name = "npz",
                             .extensions = k_extensions,
                             .read_only = k_read_only,
                             .summary = "NumPy archives: strands x points x 3, or offsets and positions",
                             .holds = {.widths = Widths::vertices, .root_uv = true, .roots = true, .attributes = true},
                             .parse = parse,
                             .format = format_npz};
  return format;
}

}  // namespace cuticle::strands::npz
