#include "lut/formats/dds/dds.h"

#include <algorithm>

#include "core/file.h"
#include "lut/format.h"
#include "lut/formats/half.h"

namespace cuticle::lut::dds {
namespace {

constexpr std::uint32_t k_magic = 0x20534444, k_dx10 = 0x30315844;  // "DDS ", "DX10"
constexpr std::uint32_t k_header_bytes = 124, k_pixel_format_bytes = 32;
constexpr std::uint32_t k_flags = 0x1 | 0x2 | 0x4 | 0x8 | 0x1000;  // caps, height, width, pitch, pixel format
constexpr std::uint32_t k_four_cc = 0x4, k_texture = 0x1000;
constexpr std::uint32_t k_rgba16_float = 10, k_texture_2d = 3;
constexpr std::uint32_t k_alpha_is_data = 4;  // DDS_ALPHA_MODE_CUSTOM: the fourth channel is no transparency
constexpr std::size_t k_texels_at = 148;

void put_zeros(ByteWriter& out, int count) {
  for (int i = 0; i < count; ++i) out.u32(0);
}

void put_header(ByteWriter& out, const Image& image) {
  out.u32(k_magic);
  out.u32(k_header_bytes);
  out.u32(k_flags);
  out.u32(std::uint32_t(image.height));
  out.u32(std::uint32_t(image.width));
  out.u32(std::uint32_t(image.width * k_bytes_of_half_texel));
  out.u32(0);  // depth
  out.u32(1);  // mip levels
  put_zeros(out, 11);
  out.u32(k_pixel_format_bytes);
  out.u32(k_four_cc);
  out.u32(k_dx10);
  put_zeros(out, 5);
  out.u32(k_texture);
  put_zeros(out, 4);
}

void put_dx10_header(ByteWriter& out) {
  out.u32(k_rgba16_float);
  out.u32(k_texture_2d);
  out.u32(0);  // no cube map
  out.u32(1);  // array size
  out.u32(k_alpha_is_data);
}

Result<void> check_header(const FieldReader& fields) {
  CUTICLE_TRY(fields.expect("magic", 0, 4, k_magic, "'DDS '"));
  CUTICLE_TRY(fields.expect("dwSize", 4, 4, k_header_bytes, "bytes of the header"));
  CUTICLE_TRY(fields.expect("ddspf.dwSize", 76, 4, k_pixel_format_bytes, "bytes of the pixel format"));
  CUTICLE_TRY(fields.expect("ddspf.dwFourCC", 84, 4, k_dx10, "'DX10'"));
  CUTICLE_TRY(fields.expect("dxgiFormat", 128, 4, k_rgba16_float, "DXGI_FORMAT_R16G16B16A16_FLOAT"));
  CUTICLE_TRY(fields.expect("resourceDimension", 132, 4, k_texture_2d, "a 2D texture"));
  return fields.expect("arraySize", 140, 4, 1, "one texture");
}

Result<void> write(const std::string& path, const Image& image, const std::string&) {
  ByteWriter out;
  put_header(out, image);
  put_dx10_header(out);
  put_half_texels(out, image);
  return write_file(path, out.bytes());
}

Result<int> levels(const std::string& path) {
  CUTICLE_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
  CUTICLE_ASSIGN(const std::uint64_t count, FieldReader(bytes, path).within("dwMipMapCount", 28, 4, 0, k_max_levels));
  return std::max(int(count), 1);  // 0: the field is not used
}

}  // namespace

Result<Image> parse(std::span<const std::byte> bytes, const std::string& file) {
  const FieldReader fields(bytes, file);
  CUTICLE_TRY(check_header(fields));
  CUTICLE_ASSIGN(const std::uint64_t height, fields.within("dwHeight", 12, 4, 1, k_largest_side));
  CUTICLE_ASSIGN(const std::uint64_t width, fields.within("dwWidth", 16, 4, 1, k_largest_side));
  CUTICLE_ASSIGN(const auto texels, fields.part("texels", k_texels_at, width * height * k_bytes_of_half_texel));
  return half_texels(texels, int(width), int(height));
}

const Format& entry() {
  static const Format format{"dds",          "dds", "DDS, DX10 header, R16G16B16A16_FLOAT",
                             k_largest_half, false, 0,
                             nearest_half,   write, read_with<parse>,
                             levels};
  return format;
}

}  // namespace cuticle::lut::dds
