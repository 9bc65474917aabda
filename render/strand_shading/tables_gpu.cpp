#include "render/strand_shading/tables_gpu.h"

#include <algorithm>

#include <fmt/format.h>

#include "lut/bake_gpu.h"

namespace cuticle::render::strand_shading {

namespace {

constexpr std::uint32_t k_is_read = 32, k_is_colour = 16;  ///< beside table and channel in a factor's six bits
constexpr std::uint32_t k_over_angles = 1, k_from_caustic = 2, k_over_cos2 = 4, k_stored_cosine = 8, k_fourth = 16,
                        k_over_half = 32;

/// The channel called `name`, as tables.glsl has it; 0: there is none.
std::uint32_t factor_code(const lut::TableSet& set, std::string_view name) {
  for (std::uint32_t t = 0; t < set.tables.size(); ++t) {
    const auto channels = set.tables[t].layout->channels;
    for (std::uint32_t c = 0; c < channels.size(); ++c) {
      const std::uint32_t code = k_is_read | t | c << 2;
      if (channels[c].name == name) return code;
      if (channels[c].name == fmt::format("{}.r", name)) return code | k_is_colour;
    }
  }
  return 0;
}

std::uint32_t term_code(const lut::TableSet& set, const lut::Term& term) {
  return factor_code(set, term.factors[0]) | factor_code(set, term.factors[1]) << 6;
}

bool is_angle(lut::AxisQuantity quantity) {
  return quantity >= lut::AxisQuantity::theta_i && quantity <= lut::AxisQuantity::abs_theta_o;
}

std::uint32_t reading(const lut::TableSet& set) {
  std::uint32_t flags = set.layout->over_cos2_theta_d ? k_over_cos2 : 0;
  for (const lut::Table& table : set.tables) {
    const auto u = table.layout->u.quantity, v = table.layout->v.quantity;
    if (is_angle(u) || is_angle(v)) flags |= k_over_angles;
    if (lut::is_of_half_vector(u) || lut::is_of_half_vector(v)) flags |= k_over_half;
    if (u == lut::AxisQuantity::from_caustic) flags |= k_from_caustic;
  }
  const auto first = set.tables.front().layout->channels;
  if (first.size() == 4 && first[3].source == lut::ChannelSource::cos_theta_d) flags |= k_stored_cosine;
  return set.tables.size() > k_drawn_textures ? flags | k_fourth : flags;
}

Result<void> check_drawable(const lut::TableSet& set) {
  const std::span<const lut::Term> terms = set.layout->terms;
  const bool read = !terms.empty() && terms.size() <= 4 && set.tables.size() <= k_max_tables &&
                    std::ranges::all_of(terms, [](const lut::Term& term) { return term.factors[2].empty(); });
  if (read) return {};
  return bad_input(fmt::format("material.layout = '{}': its tables do not make S of at most four tables and four "
                               "products of two",
                               set.layout->entry.name),
                   "use another layout, or material.evaluate 'direct'");
}

/// Of the table in its own texture, or in the one that holds all past the second.
glm::vec4 map_of(const lut::TableSet& set, std::size_t index) {
  const lut::TableLayout& table = *set.tables[index].layout;
  const lut::AxisMap u = lut::axis_map(table.u, set.size), v = lut::axis_map(table.v, set.size);
  if (index + 1 < k_drawn_textures) return {u.scale, v.scale, u.bias, v.bias};
  double above = 0, all = 0;
  for (std::size_t t = k_drawn_textures - 1; t < set.tables.size(); ++t) {
    if (t == index) above = all;
    all += lut::table_size(*set.tables[t].layout, set.size).y;
  }
  const double rows = lut::table_size(table, set.size).y;
  return {u.scale, v.scale * rows / all, u.bias, (v.bias * rows + above) / all};
}

glm::vec4 scale_of(const lut::Table& table) {
  glm::vec4 scale{1};
  for (std::size_t c = 0; c < std::min<std::size_t>(table.scale.size(), 4); ++c) scale[int(c)] = float(table.scale[c]);
  return scale;
}

/// All tables past the second, one below the other, with the channels of the one that has most.
lut::TableSet stacked(const lut::TableSet& set) {
  lut::TableSet joined = set;
  joined.tables.resize(k_drawn_textures);
  const std::span<const lut::Table> below = std::span(set.tables).subspan(k_drawn_textures - 1);
  lut::Table& all = joined.tables.back();
  all = *std::ranges::max_element(below, {}, [](const lut::Table& table) { return table.image.channels(); });
  Image& image = all.image;
  image.pixels.clear();
  image.height = 0;
  for (const lut::Table& table : below) {
    const int from = image.height;
    image.height += table.image.height;
    image.pixels.resize(std::size_t(image.width * image.height * image.channels()), 0.0F);
    for (int y = 0; y < table.image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < table.image.channels(); ++c) image.at(x, from + y, c) = table.image.at(x, y, c);
  }
  return joined;
}

}  // namespace

Result<DrawnTables> drawn_tables(const lut::TableSet& set) {
  CUTICLE_TRY(check_drawable(set));
  DrawnTables drawn;
  for (std::size_t t = 0; t < set.tables.size(); ++t) {
    const lut::Table& table = set.tables[t];
    drawn.maps[t] = map_of(set, t);
    drawn.scales[t] = scale_of(table);
    drawn.constants[0] |= std::uint32_t(table.layout->u.quantity) << 8 * t;
    drawn.constants[0] |= std::uint32_t(table.layout->v.quantity) << (8 * t + 4);
    if (table.layout->u.quantity == lut::AxisQuantity::from_caustic)
      drawn.caustic = {table.caustic_index * table.caustic_index - 1, 1.0 / (set.size - 1)};
  }
  for (std::size_t k = 0; k < set.layout->terms.size(); ++k)
    drawn.constants[1 + k / 2] |= term_code(set, set.layout->terms[k]) << 12 * (k % 2);
  drawn.constants[3] = reading(set);
  return drawn;
}

Result<std::vector<gpu::Texture>> upload_drawn(gpu::Device& device, const lut::TableSet& set, bool mip_levels) {
  if (set.tables.size() <= k_drawn_textures) return lut::upload(device, set, mip_levels);
  return lut::upload(device, stacked(set), false);
}

std::vector<std::uint32_t> with_layout(std::vector<std::uint32_t> before, const lut::TableSet* set) {
  std::array<std::uint32_t, 4> constants{};
  if (set)
    if (const Result<DrawnTables> drawn = drawn_tables(*set); drawn.ok()) constants = drawn->constants;
  before.insert(before.end(), constants.begin(), constants.end());
  return before;
}

}  // namespace cuticle::render::strand_shading
