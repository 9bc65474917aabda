#include "strands/formats/tfx/bones.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "strands/formats/bytes.h"

namespace cuticle::strands {

namespace {

constexpr std::uint64_t k_influences = 4, k_strand_bytes = 4 + k_influences * 8, k_longest_name = 255;

/// A count at `offset`, which moves past it; the rest of the file must have room for `least` bytes each.
Result<std::uint32_t> next_count(const ByteView& bytes, const char* field, std::uint64_t& offset, std::uint64_t least) {
  if (!bytes.has(offset, 4)) return bytes.error(field, offset, "the file ends before it");
  const std::uint32_t count = bytes.at<std::uint32_t>(offset);
  const std::uint64_t room = (bytes.size() - offset - 4) / least;
  if (count < 1 || count > room)
    return bytes.error(field, offset,
                       fmt::format("{}, allowed 1 .. {} in a file of {} bytes", count, room, bytes.size()));
  offset += 4;
  return count;
}

Result<std::string> next_name(const ByteView& bytes, std::uint64_t& offset) {
  if (!bytes.has(offset, 8)) return bytes.error("bone", offset, "the file ends before it");
  const std::uint64_t length_at = offset + 4, length = bytes.at<std::uint32_t>(length_at);
  if (length < 1 || length > k_longest_name || !bytes.has(length_at + 4, length))
    return bytes.error("length of the bone's name", length_at,
                       fmt::format("{}, allowed 1 .. {} within the file", length, k_longest_name));
  const auto* begin = reinterpret_cast<const char*>(bytes.data() + length_at + 4);
  offset = length_at + 4 + length;
  return std::string(begin, std::find(begin, begin + length, '\0'));
}

Result<void> read_influence(const ByteView& bytes, std::uint64_t offset, std::size_t bones, std::uint32_t& index,
                            float& weight) {
  const std::int32_t bone = bytes.at<std::int32_t>(offset);
  weight = bytes.at<float>(offset + 4);
  if (!std::isfinite(weight) || weight < 0)
    return bytes.error("weight", offset + 4, fmt::format("{}, must be finite and at least 0", double(weight)));
  if (bone < 0 || weight == 0)
    weight = 0;
  else if (std::size_t(bone) >= bones)
    return bytes.error("bone", offset, fmt::format("{}, allowed -1 .. {}", bone, bones - 1));
  index = weight > 0 ? std::uint32_t(bone) : 0;
  return {};
}

}  // namespace

Result<BoneWeights> parse_tfxbone(std::span<const std::byte> data, const std::string& where) {
  const ByteView bytes(data, where);
  BoneWeights result;
  std::uint64_t offset = 0;
  CUTICLE_ASSIGN(const std::uint32_t bones, next_count(bytes, "count of bones", offset, 9));
  for (std::uint32_t b = 0; b < bones; ++b) {
    CUTICLE_ASSIGN(std::string name, next_name(bytes, offset));
    result.bones.push_back(std::move(name));
  }
  CUTICLE_ASSIGN(const std::uint32_t strands, next_count(bytes, "count of strands", offset, k_strand_bytes));
  result.index.resize(strands);
  result.weight.resize(strands);
  for (std::uint32_t s = 0; s < strands; ++s, offset += k_strand_bytes)
    for (std::uint64_t i = 0; i < k_influences; ++i)
      CUTICLE_TRY(read_influence(bytes, offset + 4 + 8 * i, bones, result.index[s][i], result.weight[s][i]));
  return result;
}

Result<void> add_bones(const BoneWeights& weights, const std::string& where, ParsedGroom& parsed) {
  const std::size_t strands = parsed.groom.strand_count();
  if (weights.index.size() > strands)
    return bad_input(fmt::format("{}: bones of {} strands, the groom has {}", where, weights.index.size(), strands));
  Attribute index{Attribute::Domain::strand, 4, {}}, weight = index;
  std::size_t unbound = 0;
  for (std::size_t s = 0; s < strands; ++s) {
    const std::size_t from = std::min(s, weights.index.size() - 1);
    index.values.insert(index.values.end(), weights.index[from].begin(), weights.index[from].end());
    weight.values.insert(weight.values.end(), weights.weight[from].begin(), weights.weight[from].end());
    unbound += *std::max_element(weights.weight[from].begin(), weights.weight[from].end()) == 0;
  }
  parsed.groom.attributes["bone_index"] = std::move(index);
  parsed.groom.attributes["bone_weight"] = std::move(weight);
  std::string names;
  for (const std::string& bone : weights.bones) names += " " + bone;
  parsed.notes.push_back(fmt::format("{}: {} bones:{}", where, weights.bones.size(), names));
  if (unbound > 0) parsed.notes.push_back(fmt::format("{} strands have no bone of a weight above 0", unbound));
  return {};
}

}  // namespace cuticle::strands
