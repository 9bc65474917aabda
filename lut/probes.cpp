#include "lut/probes.h"

#include <algorithm>

#include <fmt/format.h>
#include <openssl/evp.h>

#include "core/file.h"

namespace cuticle::lut {
namespace {

constexpr double k_share_of_maximum = 2e-3, k_steps = 1.5;

/// Where a probe lies along an axis: at the centre of the texel at a share of the side, plus a part of a texel; or on
/// the texture's border.
struct Place {
  double share, part;
};
constexpr Place k_first{0, 0}, k_last{1, 0}, k_near_border{0, -0.5}, k_far_border{1, 0.5};
struct PlacePair {
  Place u, v;
  bool interpolated;
};
/// The inner ones stand where the lobes of M and N are tall for common hair.
constexpr PlacePair k_places[] = {
    {k_first, k_first, false},
    {k_last, k_first, false},
    {k_first, k_last, false},
    {k_last, k_last, false},
    {{0.70, 0}, {0.34, 0}, false},
    {{0.62, 0.25}, {0.44, 0.25}, true},
    {{0.30, 0.5}, {0.64, 0.25}, true},
    {{0.84, 0.25}, {0.22, 0.5}, true},
    {k_near_border, {0.55, 0.25}, true},
    {{0.40, 0.25}, k_far_border, true},
};

/// One row or column reads the same everywhere.
double coordinate(const Place& place, int side) {
  if (side == 1) return 0.5;
  return (int(place.share * (side - 1)) + 0.5 + place.part) / side;
}

std::string digest(std::span<const std::byte> bytes) {
  unsigned char found[EVP_MAX_MD_SIZE];
  unsigned int length = 0;
  [[maybe_unused]] const int done = EVP_Digest(bytes.data(), bytes.size(), found, &length, EVP_sha256(), nullptr);
  CUTICLE_EXPECT(done == 1, "libcrypto offers SHA-256");
  std::string text;
  for (unsigned int i = 0; i < length; ++i) text += fmt::format("{:02x}", found[i]);
  return text;
}

}  // namespace

std::vector<Probe> probes_of(const Table& table) {
  std::vector<Probe> probes;
  for (const PlacePair& place : k_places) {
    Probe probe{
        coordinate(place.u, table.image.width), coordinate(place.v, table.image.height), place.interpolated, {}};
    for (int c = 0; c < table.image.channels(); ++c) probe.values.push_back(sample(table, c, probe.u, probe.v));
    probes.push_back(std::move(probe));
  }
  return probes;
}

double probe_tolerance(const Format& format, double maximum) {
  return (k_share_of_maximum + k_steps * format.filter_step) * maximum;
}

double channel_maximum(const Table& table, int channel) {
  double largest = 0;
  for (std::size_t i = channel; i < table.image.pixels.size(); i += table.scale.size())
    largest = std::max(largest, double(table.image.pixels[i]) * table.scale[channel]);
  return largest;
}

Result<std::string> sha256_of_file(const std::string& path) {
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
  return digest(bytes);
}

std::string sha256_of(std::string_view text) { return digest(std::as_bytes(std::span(text.data(), text.size()))); }

}  // namespace cuticle::lut
