#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/file.h"
#include "core/image/detail/picture_library.h"
#include "core/image/image.h"

namespace cuticle::image_test {
namespace {

namespace fs = std::filesystem;

class ImageTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cuticle_image_test_" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  fs::path folder_;
};

Image gradient(int width, int height, std::vector<std::string> names) {
  Image image = make_image(width, height, std::move(names));
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(i) * 0.37f - 2.5f;
  return image;
}

TEST_F(ImageTest, ExrInFloat_ComesBackExactly) {
  const Image image = gradient(7, 5, {"R", "G", "B", "A"});
  ASSERT_TRUE(write_exr(path("a.exr"), image, ExrType::single));
  const Image back = read_exr(path("a.exr")).value();
  EXPECT_EQ(back.pixels, image.pixels);
  EXPECT_EQ(back.channel_names, image.channel_names);
  EXPECT_EQ(back.width, 7);
}

TEST_F(ImageTest, ExrInHalf_ComesBackRoundedToHalf) {
  const Image image = gradient(7, 5, {"R", "G", "B"});
  ASSERT_TRUE(write_exr(path("a.exr"), image, ExrType::half));
  const Image back = read_exr(path("a.exr")).value();
  for (std::size_t i = 0; i < image.pixels.size(); ++i) EXPECT_EQ(back.pixels[i], round_to_half(image.pixels[i]));
}

TEST_F(ImageTest, ExrWithLayers_KeepsEachChannel) {
  const Image image = gradient(3, 2, {"M_R", "M_TT", "cos_theta_d", "velocity.X", "velocity.Y"});
  ASSERT_TRUE(write_exr(path("a.exr"), image, ExrType::single));
  const Image back = read_exr(path("a.exr")).value();
  ASSERT_EQ(back.channels(), 5);
  for (int c = 0; c < 5; ++c) {
    const auto found = std::find(back.channel_names.begin(), back.channel_names.end(), image.channel_names[std::size_t(c)]);
    ASSERT_NE(found, back.channel_names.end());
    EXPECT_EQ(back.at(2, 1, int(found - back.channel_names.begin())), image.at(2, 1, c));
  }
}

TEST_F(ImageTest, ExrAttributes_ComeBack) {
  ASSERT_TRUE(write_exr(path("a.exr"), gradient(2, 2, {"R"}), ExrType::half, {{"model", "marschner"}, {"settings", "eta=1.55,a=\"b\""}}));
  const auto attributes = read_exr_attributes(path("a.exr")).value();
  EXPECT_EQ(attributes.at("model"), "marschner");
  EXPECT_EQ(attributes.at("settings"), "eta=1.55,a=\"b\"");
}

TEST_F(ImageTest, ExrTruncatedOrText_IsBadInputNamingTheFile) {
  ASSERT_TRUE(write_exr(path("a.exr"), gradient(64, 64, {"R", "G", "B"}), ExrType::single));
  const std::string whole = read_text_file(path("a.exr")).value();
  for (std::size_t keep : {std::size_t(0), std::size_t(3), std::size_t(60), whole.size() / 2}) {
    ASSERT_TRUE(write_text_file(path("cut.exr"), std::string_view(whole).substr(0, keep)));
    const Result<Image> back = read_exr(path("cut.exr"));
    ASSERT_FALSE(back) << keep;
    EXPECT_EQ(back.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(back.error().message, ::testing::HasSubstr("cut.exr"));
  }
}

TEST_F(ImageTest, ExrThatCannotBeWritten_LeavesNothing) {
  EXPECT_FALSE(write_exr(path("missing/a.exr"), gradient(2, 2, {"R"}), ExrType::half));
  EXPECT_FALSE(write_exr(path("a.exr"), make_image(0, 4, {"R"}), ExrType::half));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(ImageTest, Png_ComesBackWithinHalfAStep) {
  Image image = make_image(16, 4, {"R", "G", "B", "A"});
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(i) / float(image.pixels.size() - 1);
  for (int bits : {8, 16}) {
    ASSERT_TRUE(write_png(path("a.png"), image, bits));
    const Image back = read_image(path("a.png")).value();
    ASSERT_EQ(back.pixels.size(), image.pixels.size());
    const float half_step = 0.5f / float((1 << bits) - 1);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) EXPECT_NEAR(back.pixels[i], image.pixels[i], half_step * 1.001f) << bits;
  }
}

TEST_F(ImageTest, Png_ClampsWhatLiesOutside) {
  Image image = make_image(3, 1, {"R"});
  image.pixels = {-4.0f, 9.0f, std::nanf("")};
  ASSERT_TRUE(write_png(path("a.png"), image));
  EXPECT_EQ(read_image(path("a.png")).value().pixels, (std::vector<float>{0, 1, 0}));
}

TEST_F(ImageTest, Png_RefusesOddDepthsAndTooManyChannels) {
  EXPECT_FALSE(write_png(path("a.png"), gradient(2, 2, {"R"}), 12));
  EXPECT_FALSE(write_png(path("a.png"), gradient(2, 2, {"1", "2", "3", "4", "5"})));
}

TEST_F(ImageTest, PictureThatIsNone_IsBadInput) {
  ASSERT_TRUE(write_text_file(path("a.png"), "not a picture"));
  EXPECT_EQ(read_image(path("a.png")).error().kind, ErrorKind::bad_input);
  EXPECT_EQ(read_image(path("absent.png")).error().kind, ErrorKind::bad_input);
}

TEST_F(ImageTest, PictureThatStatesMoreThanItsBytesHold_IsRefusedBeforeMemoryIsTaken) {
  ASSERT_TRUE(write_text_file(path("a.ppm"), "P6 60000 60000 255\nxx"));
  const Result<Image> ppm = read_image(path("a.ppm"));
  ASSERT_FALSE(ppm);
  EXPECT_THAT(ppm.error().message, ::testing::HasSubstr("60000 x 60000"));
  std::string exr = [&] {
    EXPECT_TRUE(write_exr(path("a.exr"), gradient(2, 2, {"R", "G", "B", "A"}), ExrType::single));
    return read_text_file(path("a.exr")).value();
  }();
  // The window's corner: both numbers become 2^30, whose product with 16 bytes a pixel leaves nothing of 64 bits.
  const std::size_t window = exr.find("box2i", exr.find("dataWindow")) + 6 + 4 + 8;
  const std::uint32_t corner = (1u << 30) - 1;
  for (int i : {0, 4}) std::memcpy(exr.data() + window + i, &corner, 4);
  ASSERT_TRUE(write_text_file(path("a.exr"), exr));
  EXPECT_EQ(read_exr(path("a.exr")).error().kind, ErrorKind::bad_input);
}

TEST_F(ImageTest, SizesOfPictures_AreCheckedAgainstLengthAndMemory) {
  ASSERT_TRUE(write_text_file(path("a"), std::string(1000, 'x')));
  EXPECT_TRUE(detail::check_picture(path("a"), {1024, 1024, 1, 4}));
  EXPECT_FALSE(detail::check_picture(path("a"), {16384, 16384, 1, 4}));
  EXPECT_FALSE(detail::check_picture(path("a"), {16, 16, 2, 4})) << "a volume has more numbers than an Image";
  EXPECT_FALSE(detail::check_picture(path("a"), {-16, 16, 1, 4}));
  const std::int64_t huge = std::int64_t(1) << 31;
  EXPECT_FALSE(detail::check_picture(path("a"), {huge, huge, 1, 4})) << "2^64 bytes are none in 64 bits";
}

TEST(ToneMap, BlackAndAlpha_AreKept) {
  Image image = make_image(1, 1, {"R", "G", "B", "A"});
  image.pixels = {0, -1, std::nanf(""), 0.25f};
  EXPECT_EQ(tone_map(image).pixels, (std::vector<float>{0, 0, 0, 0.25f}));
}

TEST(ToneMap, MidGrey_IsThePlainSrgbCurve) {
  Image image = make_image(1, 1, {"R"});
  image.pixels = {0.214041f};
  EXPECT_NEAR(tone_map(image).pixels[0], 0.5f, 1e-5f);
  EXPECT_NEAR(tone_map(image, 1).pixels[0], 0.6858f, 2e-3f);
}

TEST(ToneMap, BrightColour_StaysACoolerOrWarmerOne) {
  Image image = make_image(1, 1, {"R", "G", "B"});
  image.pixels = {4, 2, 1};
  const Image display = tone_map(image);
  EXPECT_GT(display.pixels[0], 0.97f);
  EXPECT_LT(display.pixels[2], 0.75f) << "each channel on its own curve gives 0.95: white";
}

TEST(ToneMap, BrighterInput_IsNeverDarkerAndNeverAboveOne) {
  Image image = make_image(4000, 1, {"R"});
  for (int x = 0; x < 4000; ++x) image.at(x, 0, 0) = 1e-4f * std::pow(1.006f, float(x));
  const Image display = tone_map(image);
  for (int x = 1; x < 4000; ++x) EXPECT_GE(display.pixels[std::size_t(x)], display.pixels[std::size_t(x) - 1]);
  EXPECT_LE(display.pixels.back(), 1.0f);
}

TEST(ContactSheet, FiveInTwoColumns_FillRowsFromTheTop) {
  std::vector<Image> images;
  for (int i = 0; i < 5; ++i) {
    images.push_back(make_image(2, 3, {"R"}));
    images.back().pixels.assign(6, float(i + 1));
  }
  const Image sheet = contact_sheet(images, 2);
  EXPECT_EQ(sheet.width, 4);
  EXPECT_EQ(sheet.height, 9);
  EXPECT_EQ(sheet.at(3, 0, 0), 2.0f);
  EXPECT_EQ(sheet.at(0, 8, 0), 5.0f);
  EXPECT_EQ(sheet.at(2, 8, 0), 1.0f);
}

TEST(RoundToHalf, HalfWay_RoundsToEven) {
  EXPECT_EQ(round_to_half(2049.0f), 2048.0f);
  EXPECT_EQ(round_to_half(2051.0f), 2052.0f);
}

}  // namespace
}  // namespace cuticle::image_test
