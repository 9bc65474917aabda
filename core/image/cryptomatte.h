#pragma once
// Mattes by name: which objects a pixel sees and how much of each, as compositing programs select them
// (Cryptomatte 1.2, Friedman and Jones 2015).
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "core/image/deep.h"

namespace cuticle {

/// MurmurHash3 (32 bit, seed 0) of a text, as Cryptomatte names objects.
std::uint32_t murmur_hash(std::string_view text);
/// The float that stands for an object: its name's hash, with an exponent that no special number has.
float matte_id(std::string_view name);

/// Objects of a pixel that a matte keeps, those that it sees most of; what others cover is left out of its weights.
inline constexpr int k_matte_ranks = 6;

/// Adds a matte to a picture of floats: channels LAYER00.R .. LAYER02.A (id, weight, twice in each), from the most to
/// the least weight, and to the file's attributes its name, hash, conversion and manifest. Shares of the same name
/// count as one object; object 0 is none, and an empty name leaves a share out. Test: cryptomatte_test.
void add_matte(Image& image, std::map<std::string, std::string>& attributes, std::string_view layer,
               std::span<const SeenShare> shares, const std::function<std::string(std::uint32_t object)>& name_of);

}  // namespace cuticle
