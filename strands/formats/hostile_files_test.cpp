// Files that state other counts than they hold. The bytes end where memory ends, so that reading one more ends the
// test.
#include <cstring>
#include <string>

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>
#include <zlib.h>

#include "core/memory_limit.h"
#include "strands/formats/bytes.h"
#include "strands/formats/curve_basis.h"
#include "strands/formats/format.h"

namespace cuticle::strands::hostile_files_test {
namespace {

using testing::HasSubstr;

/// Bytes at the very end of a page; the next page may not be touched.
class GuardedBytes {
 public:
  explicit GuardedBytes(std::string_view text) : size_(text.size()) {
    const std::size_t page = std::size_t(::sysconf(_SC_PAGESIZE));
    length_ = (size_ / page + 2) * page;
    memory_ = static_cast<char*>(::mmap(nullptr, length_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    ::mprotect(memory_ + length_ - page, page, PROT_NONE);
    begin_ = memory_ + length_ - page - size_;
    std::memcpy(begin_, text.data(), size_);
  }
  ~GuardedBytes() { ::munmap(memory_, length_); }
  GuardedBytes(const GuardedBytes&) = delete;
  GuardedBytes& operator=(const GuardedBytes&) = delete;
  std::span<const std::byte> span() const { return {reinterpret_cast<const std::byte*>(begin_), size_}; }

 private:
  std::size_t size_, length_ = 0;
  char *memory_ = nullptr, *begin_ = nullptr;
};

Result<ParsedGroom> parse(std::string_view name, std::string_view text, Damage damage = Damage::refuse) {
  const GuardedBytes bytes(text);
  return format_of("x." + std::string(name)).value()->parse(bytes.span(), "x", damage);
}

std::string npy(const std::string& header, std::string_view data = "") {
  std::string bytes("\x93NUMPY\1\0", 8);
  bytes += char(header.size() & 0xff);
  bytes += char(header.size() >> 8);
  return bytes.append(header).append(data);
}

TEST(HostileNpz, ArrayOfNoAxesAndNoBytes_IsRefused) {
  for (const char* type : {"<f4", "<f8", "<f2", "<u4", "<i8", "|b1"}) {
    const auto read = parse("npz", npy(fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ()}}", type)));
    ASSERT_FALSE(read) << type;
    EXPECT_THAT(read.error().message, HasSubstr("shape")) << type;
  }
}

TEST(HostileNpz, AxesWhoseProductOverflows_AreRefused) {
  const auto read =
      parse("npz", npy("{'descr': '<f4', 'fortran_order': False, 'shape': (999999999999999, 999999999999999, 3)}"));
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("shape"));
}

TEST(HostileNpz, HeaderThatEndsWithinTheType_IsRefused) {
  EXPECT_THAT(parse("npz", npy("'descr':'<f4")).error().message, HasSubstr("descr"));
}

std::string vtp(const std::string& lines, const std::string& points, const std::string& data,
                const std::string& more = "") {
  return fmt::format(
      "<VTKFile type=\"PolyData\" {}><PolyData><Piece NumberOfLines=\"1\"><Points>{}</Points><Lines>{}</Lines>"
      "<PointData>{}</PointData></Piece></PolyData></VTKFile>",
      more, points, lines, data);
}

TEST(HostileVtp, LineWithoutPoints_IsRefusedAlsoForRepair) {
  const std::string text =
      vtp("<DataArray Name=\"connectivity\" format=\"ascii\"></DataArray><DataArray Name=\"offsets\" "
          "format=\"ascii\">0</DataArray>",
          "<DataArray format=\"ascii\"></DataArray>", "<DataArray Name=\"heat\" format=\"ascii\">1 2 3</DataArray>");
  for (const Damage damage : {Damage::refuse, Damage::keep}) EXPECT_FALSE(parse("vtp", text, damage));
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (i + k < bytes.size() ? std::uint8_t(bytes[i + k]) : 0u);
    for (int k = 3; k >= 0; --k) text += digits[bits >> (6 * k) & 63];
  }
  return text;
}

/// Blocks of zeros, each of `unfolded` bytes, as VTK compresses them.
std::string packed_zeros(std::uint32_t blocks, std::uint32_t unfolded) {
  const std::string zeros(unfolded, '\0');
  std::string block(compressBound(unfolded), '\0');
  uLongf size = block.size();
  compress2(reinterpret_cast<Bytef*>(block.data()), &size, reinterpret_cast<const Bytef*>(zeros.data()), unfolded, 9);
  std::vector<std::uint32_t> header{blocks, unfolded, 0};
  header.insert(header.end(), blocks, std::uint32_t(size));
  std::string data;
  for (std::uint32_t b = 0; b < blocks; ++b) data += block.substr(0, size);
  return base64({reinterpret_cast<const char*>(header.data()), 4 * header.size()}) + base64(data);
}

class WithLimit : public testing::Test {
 protected:
  WithLimit() { set_memory_limit(64u << 20); }
  ~WithLimit() override { set_memory_limit(before_); }
  std::uint64_t before_ = memory_limit();
};

TEST_F(WithLimit, VtpThatUnfoldsBeyondIt_IsRefused) {
  const std::string text =
      vtp("", fmt::format("<DataArray type=\"Float32\" format=\"binary\">{}</DataArray>", packed_zeros(32, 1 << 20)),
          "", "compressor=\"vtkZLibDataCompressor\" header_type=\"UInt32\"");
  ASSERT_LT(text.size(), 100000u);
  const auto read = parse("vtp", text);
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("96 MiB, allowed 64 MiB"));
}

TEST_F(WithLimit, UsdaThatRepeatsMuchForEveryStrand_IsRefused) {
  std::string counts, points, values;
  for (int s = 0; s < 2000; ++s) {
    counts += "2,";
    points += "(0,0,0),(1,0,0),";
  }
  for (int i = 0; i < 10000; ++i) values += "1,";
  const auto read = parse("usda", fmt::format("#usda 1.0\ndef BasisCurves \"a\" {{ uniform token type = \"linear\" "
                                              "int[] curveVertexCounts = [{}] point3f[] points = [{}] "
                                              "float[] primvars:wide = [{}] ( elementSize = 10000 ) }}",
                                              counts, points, values));
  ASSERT_FALSE(read);
  EXPECT_THAT(read.error().message, HasSubstr("10000 numbers for each of 2000 strands needs 76 MiB"));
}

TEST(HostileCurves, SplineOfOnePoint_IsNoCurve) {
  EXPECT_FALSE(makes_a_curve({CurveBasis::Kind::b_spline, 2, true}, 1)) << "its ends are mirrored at the second point";
}

}  // namespace
}  // namespace cuticle::strands::hostile_files_test
