#include "render/passes/cards/placement_gpu.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "gpu/groups.h"
#include "render/passes/surface_shadow/surface_shadow_gpu.h"
#include "strands/spline/drawn_gpu.h"

#include <cards_place_comp.spv.h>

namespace cuticle::render::cards {

namespace {

constexpr float k_step = 0.02f;  // of v, as in cards_place.comp

struct Push {
  glm::mat4 head;
  std::uint32_t row_count, vertices_per_strand, vertex_count, shadows, surfaces;
};

std::uint32_t lights_past_surfaces(const Resources& resources) {
  return resources.find<surface_shadow::Maps>() ? std::uint32_t(resources.get<Lights>().all.size()) : 0;
}

/// The mean of strands at v, their vertices taken for even steps, as cards_place.comp takes it.
glm::vec3 mean_of(const strands::Groom& groom, std::span<const std::uint32_t> followers, float v) {
  glm::vec3 sum(0);
  for (std::uint32_t s : followers) {
    const std::span<const glm::vec3> strand = groom.strand(s);
    const float place = std::clamp(v, 0.0f, 1.0f) * float(strand.size() - 1);
    const std::size_t begin = std::min(std::size_t(place), strand.size() - 2);
    sum += glm::mix(strand[begin], strand[begin + 1], place - float(begin));
  }
  return sum / float(followers.size());
}

class Rests {
 public:
  Rests(const strands::Groom& rest, const strands::HairCards& cards) : rest_(rest), cards_(cards) {
    for (const strands::Card& card : cards.set.cards) add_followers(card.members);
    rows.resize(cards.mesh.rows.size());
    for (const strands::CardPart& part : cards.mesh.parts)
      for (std::uint32_t r = part.first_row; r < part.first_row + part.row_count; ++r) rows[r] = rest_of(part.card, r);
  }

  std::vector<CardRest> rows;
  std::vector<std::uint32_t> followers;

 private:
  void add_followers(std::span<const std::uint32_t> members) {
    first_.push_back(std::uint32_t(followers.size()));
    const std::size_t count = std::min(k_max_followers, members.size());
    for (std::size_t k = 0; k < count; ++k) followers.push_back(members[k * members.size() / count]);
    end_.push_back(std::uint32_t(followers.size()));
  }

  CardRest rest_of(std::uint32_t card, std::uint32_t r) const {
    const strands::CardRow& row = cards_.mesh.rows[r];
    const std::span<const std::uint32_t> list(followers.data() + first_[card], end_[card] - first_[card]);
    const glm::vec3 along = mean_of(rest_, list, row.v + k_step) - mean_of(rest_, list, row.v - k_step);
    const glm::vec3 tangent = glm::dot(along, along) > 0 ? glm::normalize(along) : row.tangent;
    return {.correction = {row.middle - mean_of(rest_, list, row.v), row.v},
            .across = {row.across, row.half_width},
            .tangent = {row.tangent, cards_.occlusion[2 * r]},
            .follower_tangent = {tangent, cards_.occlusion[2 * r + 1]},
            .followers = {first_[card], end_[card], cards_.set.cards[card].kind, 0}};
  }

  const strands::Groom& rest_;
  const strands::HairCards& cards_;
  std::vector<std::uint32_t> first_, end_;  ///< of each card's followers
};

}  // namespace

Result<Placement> Placement::make(gpu::Device& device, const Resources& resources, const strands::HairCards& cards) {
  const Rests rests(*resources.get<RestStrands>().groom, cards);
  Placement placement;
  placement.rows_ = std::uint32_t(rests.rows.size());
  CUTICLE_ASSIGN(placement.rests_, gpu::make_buffer_from<CardRest>(device, rests.rows));
  CUTICLE_ASSIGN(placement.followers_, gpu::make_buffer_from<std::uint32_t>(device, rests.followers));
  CUTICLE_ASSIGN(placement.placed_, device.make_buffer(rests.rows.size() * 4 * sizeof(glm::vec4)));
  const std::size_t shadows = transmittance_of(resources).reached.size(),
                    all = shadows + lights_past_surfaces(resources);
  CUTICLE_ASSIGN(placement.reached_,
                 device.make_buffer(std::max<std::size_t>(1, all * rests.rows.size()) * sizeof(float)));
  if (shadows > 0) {
    CUTICLE_ASSIGN(placement.transmittance_, GatheredTransmittance::make(device, resources));
  }
  CUTICLE_ASSIGN(
      placement.kernel_,
      device.make_kernel(cards_place_comp, {.storage_buffers = 7,
                                            .push_constant_bytes = sizeof(Push),
                                            .texels = {strands::drawn_texels(0), GatheredTransmittance::texels(4)}}));
  return placement;
}

void Placement::record(gpu::Commands& commands, const Resources& resources) const {
  const DrawnHair& hair = resources.get<DrawnHair>();
  const Push push{glm::mat4(resources.get<Surfaces>().head_transform),
                  rows_,
                  hair.vertices_per_strand,
                  hair.strands.vertex_count,
                  std::uint32_t(transmittance_of(resources).reached.size()),
                  lights_past_surfaces(resources)};
  if (transmittance_) transmittance_->record(commands, resources);
  const gpu::Groups groups = gpu::groups_for(rows_);
  commands.dispatch(
      kernel_,
      {hair.strands.vertices, &rests_, &followers_, &placed_, transmittance_ ? &transmittance_->buffer() : &rests_,
       &reached_, resources.find<surface_shadow::Maps>() ? &resources.get<surface_shadow::Maps>().visibility : &rests_},
      {}, gpu::bytes_of(push), groups.x, groups.y);
}

}  // namespace cuticle::render::cards
