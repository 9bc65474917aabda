#include "lut/formats/ktx2/ktx2.h"

#include <algorithm>

#include "core/file.h"
#include "lut/format.h"
#include "lut/formats/half.h"

namespace cuticle::lut::ktx2 {
namespace {

// The identifier: \xABKTX 20\xBB\r\n\x1A\n, as three numbers.
constexpr std::uint32_t k_identifier[] = {0x58544BAB, 0xBB303220, 0x0A1A0A0D};
constexpr std::uint32_t k_rgba16_sfloat = 97;  // VK_FORMAT_R16G16B16A16_SFLOAT
constexpr std::uint32_t k_descriptor_at = 104, k_sample_bytes = 16, k_samples = 4;
constexpr std::uint32_t k_block_bytes = 24 + k_samples * k_sample_bytes, k_descriptor_bytes = 4 + k_block_bytes;
constexpr std::uint32_t k_minus_one = 0xBF800000, k_plus_one = 0x3F800000;  // as floats

/// A key, its value and the terminating zeros, as the specification's section "Key/Value Data" wants them.
void put_entry(ByteWriter& out, std::string_view key, std::string_view value) {
  out.u32(std::uint32_t(key.size() + value.size() + 2));
  out.text(key);
  out.u8(0);
  out.text(value);
  out.u8(0);
  out.pad_to(4);
}

ByteWriter key_values(const std::string& manifest) {
  ByteWriter out;  // sorted by key
  put_entry(out, "KTXorientation", "rd");
  put_entry(out, "KTXwriter", "cuticle");
  put_entry(out, "cuticle:manifest", manifest);
  return out;
}

void put_sample(ByteWriter& out, int index) {
  out.u16(std::uint16_t(16 * index));                      // bitOffset
  out.u8(15);                                              // bitLength - 1
  out.u8(std::uint8_t((index == 3 ? 15 : index) | 0xC0));  // channel; signed float
  out.u32(0);                                              // samplePosition
  out.u32(k_minus_one);
  out.u32(k_plus_one);
}

/// The basic descriptor block of the Khronos Data Format Specification: RGBSDA, no primaries, linear.
void put_descriptor(ByteWriter& out) {
  out.u32(k_descriptor_bytes);
  out.u32(0);  // vendor and type: Khronos, basic
  out.u16(2);  // version
  out.u16(k_block_bytes);
  out.u8(1);   // RGBSDA
  out.u8(0);   // primaries unspecified: no colour
  out.u8(1);   // transfer linear
  out.u8(0);   // straight alpha
  out.u32(0);  // texel block 1 x 1
  out.u64(k_bytes_of_half_texel);
  for (int i = 0; i < int(k_samples); ++i) put_sample(out, i);
}

void put_header(ByteWriter& out, const Image& image) {
  for (const std::uint32_t word : k_identifier) out.u32(word);
  out.u32(k_rgba16_sfloat);
  out.u32(2);  // typeSize
  out.u32(std::uint32_t(image.width));
  out.u32(std::uint32_t(image.height));
  out.u32(0);  // depth
  out.u32(0);  // layers: no array
  out.u32(1);  // faces
  out.u32(1);  // levels
  out.u32(0);  // no supercompression
}

void put_index(ByteWriter& out, std::uint32_t key_value_bytes, std::uint64_t texels_at, std::uint64_t texel_bytes) {
  out.u32(k_descriptor_at);
  out.u32(k_descriptor_bytes);
  out.u32(k_descriptor_at + k_descriptor_bytes);
  out.u32(key_value_bytes);
  out.u64(0);  // no global data of a supercompression
  out.u64(0);
  out.u64(texels_at);
  out.u64(texel_bytes);
  out.u64(texel_bytes);
}

Result<void> write(const std::string& path, const Image& image, const std::string& manifest) {
  const ByteWriter pairs = key_values(manifest);
  const std::uint64_t end = k_descriptor_at + k_descriptor_bytes + pairs.size();
  const std::uint64_t texels_at = (end + k_bytes_of_half_texel - 1) / k_bytes_of_half_texel * k_bytes_of_half_texel;
  ByteWriter out;
  put_header(out, image);
  put_index(out, std::uint32_t(pairs.size()), texels_at,
            std::uint64_t(image.width) * image.height * k_bytes_of_half_texel);
  put_descriptor(out);
  for (const std::byte byte : pairs.bytes()) out.u8(std::uint8_t(byte));
  out.pad_to(k_bytes_of_half_texel);
  put_half_texels(out, image);
  return write_file(path, out.bytes());
}

Result<void> check_header(const FieldReader& fields) {
  for (int i = 0; i < 3; ++i) CUTICLE_TRY(fields.expect("identifier", 4 * i, 4, k_identifier[i], "KTX 2.0"));
  CUTICLE_TRY(fields.expect("vkFormat", 12, 4, k_rgba16_sfloat, "VK_FORMAT_R16G16B16A16_SFLOAT"));
  CUTICLE_TRY(fields.expect("pixelDepth", 28, 4, 0, "a 2D texture"));
  CUTICLE_TRY(fields.expect("layerCount", 32, 4, 0, "no array"));
  CUTICLE_TRY(fields.expect("faceCount", 36, 4, 1, "no cube map"));
  return fields.expect("supercompressionScheme", 44, 4, 0, "none");
}

Result<int> levels(const std::string& path) {
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
  CUTICLE_ASSIGN(const std::uint64_t count, FieldReader(bytes, path).within("levelCount", 40, 4, 0, k_max_levels));
  return std::max(int(count), 1);  // 0: the loader is asked to make them
}

}  // namespace

Result<Image> parse(std::span<const std::byte> bytes, const std::string& file) {
  const FieldReader fields(bytes, file);
  CUTICLE_TRY(check_header(fields));
  CUTICLE_ASSIGN(const std::uint64_t width, fields.within("pixelWidth", 20, 4, 1, k_largest_side));
  CUTICLE_ASSIGN(const std::uint64_t height, fields.within("pixelHeight", 24, 4, 1, k_largest_side));
  CUTICLE_ASSIGN(const std::uint64_t offset, fields.number("levels[0].byteOffset", 80, 8));
  CUTICLE_TRY(
      fields.expect("levels[0].byteLength", 88, 8, width * height * k_bytes_of_half_texel, "width x height x 8"));
  CUTICLE_ASSIGN(const auto texels, fields.part("levels[0]", offset, width * height * k_bytes_of_half_texel));
  return half_texels(texels, int(width), int(height));
}

const Format& entry() {
  static const Format format{"ktx2",         "ktx2", "KTX 2.0, R16G16B16A16_SFLOAT, one level",
                             k_largest_half, false,  0,
                             nearest_half,   write,  read_with<parse>,
                             levels};
  return format;
}

}  // namespace cuticle::lut::ktx2
