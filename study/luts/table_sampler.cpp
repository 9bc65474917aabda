#include "study/luts/table_sampler.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "lut/caustic.glslh"
#include "lut/half_vector.glslh"

namespace cuticle::study {
namespace {

constexpr float k_least_cosine_squared = 1e-6f;  // of theta_d, where a layout divides by it

/// The channel called `name` in any table.
bool find_channel(const lut::TableSet& set, std::string_view name, std::size_t& table, int& channel) {
  for (table = 0; table < set.tables.size(); ++table) {
    const auto channels = set.tables[table].layout->channels;
    for (channel = 0; channel < int(channels.size()); ++channel)
      if (channels[std::size_t(channel)].name == name) return true;
  }
  return false;
}

float cosine_of(float sine) { return std::sqrt(std::max(1 - sine * sine, 0.0f)); }

lut::HalfAngles<float> half_angles_of(const ShaderInputs& in) {
  return lut::half_angles<float>({in.sin_theta_i, cosine_of(in.sin_theta_i)},
                                 {in.sin_theta_o, cosine_of(in.sin_theta_o)}, in.cos_phi, cosine_of(in.cos_phi));
}

}  // namespace

void TableSampler::add_texture(const lut::Table& table, int size) {
  const glm::ivec2 texels = lut::table_size(*table.layout, size);
  const auto address = [](const lut::Axis& axis, int count) {
    const lut::AxisMap map = lut::axis_map(axis, count);
    return Address{axis.quantity, float(map.scale), float(map.bias)};
  };
  Texture& texture = textures_.emplace_back();
  texture.size = texels;
  texture.u = address(table.layout->u, texels.x);
  texture.v = address(table.layout->v, texels.y);
  texture.glass = float(table.caustic_index * table.caustic_index - 1);
  texture.gap = 1.0F / float(texels.x - 1);
  texture.texels.assign(std::size_t(texels.x) * std::size_t(texels.y), glm::vec4(0));
  const std::size_t channels = table.scale.size();
  for (std::size_t i = 0; i < texture.texels.size(); ++i)
    for (std::size_t c = 0; c < std::min<std::size_t>(channels, 4); ++c)
      texture.texels[i][int(c)] = float(double(table.image.pixels[i * channels + c]) * table.scale[c]);
}

Result<void> TableSampler::add_terms(const lut::TableSet& set) {
  for (const lut::Term& term : set.layout->terms) {
    std::vector<Factor>& factors = terms_.emplace_back();
    for (const std::string_view name : term.factors) {
      if (name.empty()) break;
      Factor& factor = factors.emplace_back();
      if (find_channel(set, name, factor.texture, factor.channel)) continue;
      factor.is_color = find_channel(set, fmt::format("{}.r", name), factor.texture, factor.channel);
      CUTICLE_EXPECT(factor.is_color, "a layout's terms name its channels");
    }
  }
  return {};
}

Result<TableSampler> TableSampler::make(const lut::TableSet& set) {
  if (set.layout->terms.empty())
    return usage_error(fmt::format("layout {}: its tables do not make S", set.layout->entry.name));
  TableSampler sampler;
  sampler.over_cos2_theta_d_ = set.layout->over_cos2_theta_d;
  for (std::size_t t = 0; t < set.tables.size(); ++t) {
    sampler.add_texture(set.tables[t], set.size);
    const auto channels = set.tables[t].layout->channels;
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (channels[c].source == lut::ChannelSource::cos_theta_d) {
        sampler.cosine_texture_ = int(t);
        sampler.cosine_channel_ = int(c);
      }
  }
  CUTICLE_TRY(sampler.add_terms(set));
  return sampler;
}

float TableSampler::coordinate(const Address& address, const ShaderInputs& in, float cos_theta_d) const {
  const auto value = [&]() -> float {
    switch (address.quantity) {
      case lut::AxisQuantity::sin_theta_i:
        return in.sin_theta_i;
      case lut::AxisQuantity::sin_theta_o:
        return in.sin_theta_o;
      case lut::AxisQuantity::cos_phi:
        return in.cos_phi;
      case lut::AxisQuantity::cos_theta_d:
        return cos_theta_d;
      case lut::AxisQuantity::theta_i:
        return std::asin(in.sin_theta_i);
      case lut::AxisQuantity::theta_o:
        return std::asin(in.sin_theta_o);
      case lut::AxisQuantity::phi:
        return std::acos(std::clamp(in.cos_phi, -1.0f, 1.0f));
      case lut::AxisQuantity::theta_d:
        return std::acos(std::clamp(cos_theta_d, 0.0f, 1.0f));
      case lut::AxisQuantity::abs_theta_o:
        return std::abs(std::asin(in.sin_theta_o));
      case lut::AxisQuantity::theta_between:
        return half_angles_of(in).between;
      case lut::AxisQuantity::theta_half:
        return half_angles_of(in).inclination;
      case lut::AxisQuantity::phi_half:
        return half_angles_of(in).azimuth;
      case lut::AxisQuantity::cos_normal:
        return cosine_of(in.sin_theta_i) * in.cos_phi;
      default:
        return 0;
    }
  };
  return value() * address.scale + address.bias;
}

glm::vec4 TableSampler::fetch(const Texture& texture, const ShaderInputs& in, float cos_theta_d) const {
  const float v = coordinate(texture.v, in, cos_theta_d);
  if (texture.u.quantity != lut::AxisQuantity::from_caustic)
    return filtered(texture, {coordinate(texture.u, in, cos_theta_d), v});
  const float phi = std::acos(std::clamp(in.cos_phi, -1.0f, 1.0f));
  const auto beside = lut::from_caustic(texture.glass, texture.gap, phi, cos_theta_d * cos_theta_d);
  return filtered(texture, {beside.value * texture.u.scale + texture.u.bias, v}) * beside.peak;
}

glm::vec4 TableSampler::filtered(const Texture& texture, glm::vec2 coordinates) const {
  const glm::vec2 last = glm::vec2(texture.size - 1);
  const glm::vec2 place = coordinates * glm::vec2(texture.size) - 0.5f;
  const glm::vec2 held = glm::clamp(place, glm::vec2(0), last);
  const glm::ivec2 from = glm::ivec2(held), to = glm::min(from + 1, texture.size - 1);
  const glm::vec2 share = held - glm::vec2(from);
  const glm::vec4 *lower = &texture.texels[std::size_t(from.y * texture.size.x)],
                  *upper = &texture.texels[std::size_t(to.y * texture.size.x)];
  return glm::mix(glm::mix(lower[from.x], lower[to.x], share.x), glm::mix(upper[from.x], upper[to.x], share.x),
                  share.y);
}

float TableSampler::cosine_of_theta_d(const ShaderInputs& in) const {
  if (cosine_texture_ >= 0) return fetch(textures_[std::size_t(cosine_texture_)], in, 0)[cosine_channel_];
  const float cosines = std::sqrt((1 - in.sin_theta_i * in.sin_theta_i) * (1 - in.sin_theta_o * in.sin_theta_o));
  return std::sqrt(std::max(0.0f, 0.5f + 0.5f * (cosines + in.sin_theta_i * in.sin_theta_o)));
}

glm::vec3 TableSampler::scattering(const ShaderInputs& in) const {
  constexpr std::size_t k_most = 8;
  CUTICLE_EXPECT(textures_.size() <= k_most, "a layout has at most eight tables");
  const float cos_theta_d = cosine_of_theta_d(in);
  std::array<glm::vec4, k_most> values;
  for (std::size_t t = 0; t < textures_.size(); ++t) values[t] = fetch(textures_[t], in, cos_theta_d);
  glm::vec3 sum(0);
  for (const std::vector<Factor>& factors : terms_) {
    glm::vec3 product(1);
    for (const Factor& factor : factors) {
      const glm::vec4& value = values[factor.texture];
      product *= factor.is_color
                     ? glm::vec3(value[factor.channel], value[factor.channel + 1], value[factor.channel + 2])
                     : glm::vec3(value[factor.channel]);
    }
    sum += product;
  }
  return over_cos2_theta_d_ ? sum / std::max(cos_theta_d * cos_theta_d, k_least_cosine_squared) : sum;
}

}  // namespace cuticle::study
