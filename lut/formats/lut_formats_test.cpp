// Every file format: what it wrote is read back; files that are not what they should be are refused by field and
// offset.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "core/file.h"
#include "lut/format.h"
#include "lut/formats/dds/dds.h"
#include "lut/formats/ktx2/ktx2.h"

namespace cuticle::lut::lut_formats_test {
namespace {

namespace fs = std::filesystem;

std::string temporary(std::string_view name) {
  return (fs::temp_directory_path() / ("cuticle_formats_" + std::to_string(::getpid()) + std::string(name))).string();
}

/// Stored numbers over the format's whole range, its smallest steps among them.
Image numbers_of(const Format& format, int channels) {
  std::vector<std::string> names = {"R", "G", "B", "A"};
  names.resize(channels);
  Image image = make_image(8, 4, names);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = float(format.round(std::min(format.largest * std::pow(0.75, double(i)), format.largest)));
  return image;
}

Image written_and_read(const Format& format, const Image& image) {
  const std::string path = temporary(std::string("numbers.") + std::string(format.extension));
  EXPECT_TRUE(format.write(path, image, "{}").ok()) << format.name;
  const auto read = format.read(path);
  EXPECT_TRUE(read.ok()) << format.name << (read.ok() ? "" : read.error().message);
  fs::remove(path);
  return read.value();
}

TEST(Formats, AnyOfThem_ReadsBackTheNumbersThatItWrote) {
  ASSERT_GE(formats().size(), 5u);
  for (const Format* format : formats())
    for (int channels : {3, 4}) {
      const Image image = numbers_of(*format, channels), read = written_and_read(*format, image);
      ASSERT_EQ(read.width, 8);
      ASSERT_EQ(read.height, 4);
      ASSERT_GE(read.channels(), channels);
      for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x)
          for (int c = 0; c < channels; ++c)
            ASSERT_FLOAT_EQ(read.at(x, y, c), image.at(x, y, c)) << format->name << " " << x << " " << y << " " << c;
    }
}

TEST(Formats, NameThatIsNone_IsRefusedWithTheNearest) {
  const auto found = find_format("kxt2");
  ASSERT_FALSE(found.ok());
  EXPECT_EQ(found.error().kind, ErrorKind::usage);
  EXPECT_THAT(found.error().hint, testing::HasSubstr("ktx2"));
}

/// The bytes of a small file, one 32-bit field of it overwritten.
std::vector<std::byte> damaged(const char* name, std::size_t offset, std::uint32_t value) {
  const Format& format = *find_format(name).value();
  const std::string path = temporary("damaged");
  EXPECT_TRUE(format.write(path, numbers_of(format, 4), "{}").ok());
  std::vector<std::byte> bytes = read_file(path).value();
  fs::remove(path);
  for (int i = 0; i < 4; ++i) bytes[offset + i] = std::byte(value >> (8 * i));
  return bytes;
}

struct Damage {
  std::size_t offset;
  std::uint32_t value;
  const char* field;
};

TEST(Dds, WrongField_IsRefusedByNameAndOffset) {
  for (const Damage& each : {Damage{0, 1, "magic"},
                             {4, 1, "dwSize"},
                             {12, 0, "dwHeight"},
                             {16, 1u << 20, "dwWidth"},
                             {16, 9, "texels"},
                             {84, 0x31545844, "ddspf.dwFourCC"},
                             {128, 95, "dxgiFormat"},
                             {132, 4, "resourceDimension"},
                             {140, 6, "arraySize"}}) {
    const auto read = dds::parse(damaged("dds", each.offset, each.value), "M.dds");
    ASSERT_FALSE(read.ok()) << each.field;
    EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(read.error().message, testing::HasSubstr(std::string("M.dds: ") + each.field + " at offset "));
  }
}

TEST(Ktx2, WrongField_IsRefusedByNameAndOffset) {
  for (const Damage& each : {Damage{4, 1, "identifier"},
                             {12, 37, "vkFormat"},
                             {20, 0, "pixelWidth"},
                             {24, 1u << 20, "pixelHeight"},
                             {28, 1, "pixelDepth"},
                             {32, 2, "layerCount"},
                             {36, 6, "faceCount"},

                             {44, 2, "supercompressionScheme"},
                             {80, 0xFFFFFFF0, "levels[0]"},
                             {84, 0xFFFFFFFF, "levels[0]"},
                             {88, 1, "levels[0].byteLength"}}) {
    const auto read = ktx2::parse(damaged("ktx2", each.offset, each.value), "M.ktx2");
    ASSERT_FALSE(read.ok()) << each.field;
    EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(read.error().message, testing::HasSubstr(std::string("M.ktx2: ") + each.field + " at offset "));
  }
}

TEST(HalfFiles, LevelsInTheHeader_AreCounted) {
  for (const auto& [name, offset] : {std::pair{"dds", 28}, {"ktx2", 40}}) {
    const std::string path = temporary("levels");
    ASSERT_TRUE(write_file(path, damaged(name, offset, 4)).ok());
    EXPECT_EQ(find_format(name).value()->levels(path).value(), 4) << name;
    ASSERT_TRUE(write_file(path, damaged(name, offset, 99)).ok());
    EXPECT_FALSE(find_format(name).value()->levels(path).ok()) << name;
    fs::remove(path);
  }
}

TEST(HalfFiles, CutShortAnywhere_AreRefused) {
  const std::vector<std::byte> a = damaged("dds", 144, 4), b = damaged("ktx2", 16, 2);
  for (std::size_t size = 0; size < a.size(); size += 7)
    ASSERT_FALSE(dds::parse(std::span(a).first(size), "M.dds").ok()) << size;
  for (std::size_t size = 0; size < b.size(); size += 7)
    ASSERT_FALSE(ktx2::parse(std::span(b).first(size), "M.ktx2").ok()) << size;
}

}  // namespace
}  // namespace cuticle::lut::lut_formats_test
