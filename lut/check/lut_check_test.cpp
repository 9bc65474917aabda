// Tables damaged on purpose, each named; manifests damaged on purpose, each refused by key.
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "lut/check/blocks.h"
#include "lut/check/check.h"
#include "lut/format.h"
#include "lut/table_set.h"

namespace cuticle::lut::check::lut_check_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const TableSet& stored(const char* format) {
  static std::map<std::string, TableSet> made;
  const auto found = made.find(format);
  if (found != made.end()) return found->second;
  const bsdf::Model& model = *bsdf::find_model("marschner").value();
  const auto values = bsdf::parse_settings(model, "blond", "").value();
  TableSet set = bake(model, values, *find_layout("nalu").value(), 64, silent_progress()).value();
  EXPECT_TRUE(store_as(set, *find_format(format).value()).ok());
  return made.emplace(format, std::move(set)).first->second;
}

std::string manifest_text(const char* format) { return manifest_json(stored(format), *find_format(format).value()); }
Manifest manifest(const char* format) { return parse_manifest(manifest_text(format), "manifest.json").value(); }

using Damage = std::function<void(Image&)>;

template <class Value>
Damage values(Value value) {
  return [value](Image& image) {
    for (float& each : image.pixels) each = float(value(double(each)));
  };
}

/// Every texel from where the rule says, of the image as it was.
template <class From>
Damage texels(From from) {
  return [from](Image& image) {
    const Image right = image;
    for (int y = 0; y < image.height; ++y)
      for (int x = 0; x < image.width; ++x)
        for (int c = 0; c < image.channels(); ++c) image.at(x, y, c) = float(from(right, x, y, c));
  };
}

double srgb_decoded(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

double srgb_encoded(double v) { return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

int clamped(int i, int side) { return std::clamp(i, 0, side - 1); }

/// What a texture in repeat mode gives where the coordinate runs to the border.
double border_mixed(const Image& image, int x, int y, int c) {
  const int last_x = image.width - 1, last_y = image.height - 1;
  const bool at_x = x == 0 || x == last_x, at_y = y == 0 || y == last_y;
  const int x2 = at_x ? last_x - x : x, y2 = at_y ? last_y - y : y;
  return (double(image.at(x, y, c)) + double(image.at(x2, y, c)) + double(image.at(x, y2, c)) +
          double(image.at(x2, y2, c))) /
         4;
}

double shifted(const Image& image, int x, int y, int c) {
  return (double(image.at(x, y, c)) + double(image.at(clamped(x + 1, image.width), y, c))) / 2;
}

/// Four values a block, as BC1; `in_bits`: sixteen, evenly spaced in the bits of half floats, as BC6H.
template <bool in_bits>
double compressed(const Image& image, int x, int y, int c) {
  const auto code = [](float value) { return in_bits ? double(glm::packHalf1x16(value)) : double(value); };
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int j = 0; j < 16; ++j) {
    const double value = code(image.at(x / 4 * 4 + j % 4, y / 4 * 4 + j / 4, c));
    low = std::min(low, value), high = std::max(high, value);
  }
  const double steps = in_bits ? 15 : 3;
  const double place = high > low ? std::round((code(image.at(x, y, c)) - low) / (high - low) * steps) / steps : 0;
  const double found = low + place * (high - low);
  return in_bits ? double(glm::unpackHalf1x16(std::uint16_t(std::lround(found)))) : found;
}

double mean_of_square(const Image& image, int x, int y, int c) {
  const int x0 = x / 2 * 2, y0 = y / 2 * 2;
  return (double(image.at(x0, y0, c)) + double(image.at(x0 + 1, y0, c)) + double(image.at(x0, y0 + 1, c)) +
          double(image.at(x0 + 1, y0 + 1, c))) /
         4;
}

void halve(Image& image) {
  Image half = make_image(image.width / 2, image.height / 2, image.channel_names);
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x)
      for (int c = 0; c < half.channels(); ++c) half.at(x, y, c) = float(mean_of_square(image, 2 * x, 2 * y, c));
  image = half;
}

void drop_last(Image& image) {
  for (std::size_t i = image.channels() - 1; i < image.pixels.size(); i += image.channels()) image.pixels[i] = 1;
}

/// Colours as they come out of an sRGB texture, whose alpha is never decoded.
void decode_colors(Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (image.channels() < 4 || i % 4 < 3) image.pixels[i] = float(srgb_decoded(double(image.pixels[i])));
}

void premultiply(Image& image) {
  for (std::size_t i = 0; i < image.pixels.size() && image.channels() > 3; ++i)
    if (i % 4 < 3) image.pixels[i] *= image.pixels[i / 4 * 4 + 3];
}

void swap_red_and_blue(Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); i += image.channels()) std::swap(image.pixels[i], image.pixels[i + 2]);
}

void copy_red(Image& image) {
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = image.pixels[i / image.channels() * image.channels()];
}

struct Named {
  const char* name;
  Damage damage;
};

std::vector<Named> damages() {
  return {
      {"sRGB decoded", values(srgb_decoded)},
      {"flipped in v", texels([](const Image& i, int x, int y, int c) { return i.at(x, i.height - 1 - y, c); })},
      {"flipped in u", texels([](const Image& i, int x, int y, int c) { return i.at(i.width - 1 - x, y, c); })},
      {"u and v swapped", texels([](const Image& i, int x, int y, int c) { return i.at(y, x, c); })},
      {"wrapped", texels(border_mixed)},
      {"half-texel shifted", texels(shifted)},
      {"block-compressed", texels(compressed<false>)},
      {"block-compressed", texels(compressed<true>)},
      {"mip-mapped", texels(mean_of_square)},
      {"resized", halve},
      {"sRGB decoded", decode_colors},
      {"sRGB encoded", values(srgb_encoded)},
      {"premultiplied alpha", premultiply},
      {"channels swapped", swap_red_and_blue},
      {"channel dropped", copy_red},
      {"channel dropped", drop_last},
      {"wrong scale", values([](double v) { return v * 57.29577951308232; })},
  };
}

/// M of blond hair is nearly alike in both angles, so that a swap harms less than the tolerance. N_TRT has no alpha.
bool harmless(const std::string& table, const std::string& name) {
  return (table == "M" && name == "u and v swapped") || (table == "N_TRT" && name == "premultiplied alpha");
}

TEST(CheckLut, EachDamageOfEachTable_IsNamed) {
  for (const char* format : {"exr", "png16"})
    for (std::size_t t = 0; t < 3; ++t)
      for (const Named& each : damages()) {
        const ManifestTable table = manifest(format).tables[t];
        Image image = stored(format).tables[t].image;
        each.damage(image);
        if (std::string_view(format) == "exr") values([](double v) { return double(round_to_half(float(v))); })(image);
        const TableVerdict verdict = check_table(table, image);
        if (verdict.passed && harmless(table.name, each.name)) continue;
        EXPECT_FALSE(verdict.passed) << format << " " << table.name << " " << each.name;
        EXPECT_EQ(verdict.mistake.name, each.name) << format << " " << table.name << ": " << verdict.mistake.evidence;
        EXPECT_FALSE(verdict.mistake.remedy.empty());
      }
}

TEST(CheckLut, ColoursDecodedOrMultipliedAndRoundedToTheFormatsBits_AreNamed) {
  const Named wrong[] = {{"sRGB decoded", values(srgb_decoded)},
                         {"sRGB decoded", decode_colors},
                         {"premultiplied alpha", premultiply},
                         {"channels swapped", swap_red_and_blue}};
  for (const char* name : {"png8", "png16"}) {
    const Format& format = *find_format(name).value();
    for (std::size_t t = 0; t < 3; ++t)
      for (const Named& each : wrong) {
        const ManifestTable table = manifest(name).tables[t];
        Image image = stored(name).tables[t].image;
        each.damage(image);
        values([&](double v) { return format.round(std::clamp(v, 0.0, 1.0)); })(image);
        const TableVerdict verdict = check_table(table, image);
        if (verdict.passed && harmless(table.name, each.name)) continue;
        EXPECT_EQ(verdict.mistake.name, each.name) << name << " " << table.name << ": " << verdict.mistake.evidence;
        if (verdict.mistake.name == "channels swapped") {
          EXPECT_NE(verdict.mistake.evidence.find("read as B, G, R"), std::string::npos) << verdict.mistake.evidence;
        }
      }
  }
}

TEST(CheckLut, HalfFloatsRoundedToBytes_AreNamed) {
  Image image = stored("exr").tables[1].image;
  values([](double v) { return std::round(std::min(v, 1.0) * 255) / 255; })(image);
  EXPECT_EQ(check_table(manifest("exr").tables[1], image).mistake.name, "half precision lost");
  values([](double v) {  // as a file of half floats keeps them: eleven binary digits
    int exponent = 0;
    const double mantissa = std::frexp(v, &exponent);
    return std::ldexp(std::round(std::ldexp(mantissa, 11)), exponent - 11);
  })(image);
  EXPECT_EQ(check_table(manifest("exr").tables[1], image).mistake.name, "half precision lost");
}

TEST(CheckLut, ValuesAboveOneCutOff_AreNamed) {
  Image image = stored("exr").tables[0].image;
  values([](double v) { return std::min(v, 1.0); })(image);
  EXPECT_EQ(check_table(manifest("exr").tables[0], image).mistake.name, "clipped at 1");
}

TEST(CheckLut, TablesAsTheyWereStored_PassInEveryFormat) {
  for (const Format* format : formats())
    for (std::size_t t = 0; t < 3; ++t) {
      const std::string name(format->name);
      const TableVerdict verdict = check_table(manifest(name.c_str()).tables[t], stored(name.c_str()).tables[t].image);
      EXPECT_TRUE(verdict.passed) << name << " " << verdict.worst;
      EXPECT_LT(verdict.misfit, 1e-3);
    }
}

TEST(CheckLut, Noise_IsAFailureWithoutAName) {
  Image image = stored("exr").tables[1].image;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] *= 1 + 0.2F * float(std::sin(double(i * i)));
  const TableVerdict verdict = check_table(manifest("exr").tables[1], image);
  EXPECT_FALSE(verdict.passed);
  EXPECT_EQ(verdict.mistake.name, "unknown");
}

TEST(Blocks, BakedTables_AreNotStepped) {
  for (const Table& table : stored("exr").tables) EXPECT_LT(share_of_stepped_blocks(table.image), 0.02);
}

class CheckedFolder : public testing::Test {
 protected:
  CheckedFolder() : folder_(fs::temp_directory_path() / fmt::format("cuticle_check_{}", ::getpid())) {}
  ~CheckedFolder() override { fs::remove_all(folder_); }
  std::string write_as(const char* format) {
    fs::remove_all(folder_);
    EXPECT_TRUE(write(stored(format), *find_format(format).value(), folder_.string()).ok());
    return folder_.string();
  }
  fs::path folder_;
};

TEST_F(CheckedFolder, AsWritten_PassesUnchangedInEveryFormat) {
  for (const Format* format : formats()) {
    const Report report = check_folder(write_as(std::string(format->name).c_str())).value();
    EXPECT_TRUE(report.passed());
    for (const TableVerdict& verdict : report.tables) EXPECT_TRUE(verdict.unchanged) << format->name;
  }
}

TEST_F(CheckedFolder, WrittenAgainByAnotherProgram_PassesButIsNotUnchanged) {
  const std::string folder = write_as("exr");
  Image image = stored("exr").tables[0].image;
  image.channel_names = {"R", "G", "B", "A"};
  ASSERT_TRUE(write_exr(folder + "/M.exr", image, ExrType::single).ok());
  const Report report = check_folder(folder).value();
  EXPECT_TRUE(report.passed());
  EXPECT_FALSE(report.tables[0].unchanged);
  EXPECT_TRUE(report.tables[1].unchanged);
}

TEST_F(CheckedFolder, FileWithLevels_IsNamedMipMapped) {
  const std::string folder = write_as("ktx2");
  std::vector<std::byte> bytes = read_file(folder + "/N_TRT.ktx2").value();
  bytes[40] = std::byte(7);
  ASSERT_TRUE(write_file(folder + "/N_TRT.ktx2", bytes).ok());
  const Report report = check_folder(folder).value();
  EXPECT_FALSE(report.passed());
  EXPECT_EQ(report.tables[2].mistake.name, "mip-mapped");
  EXPECT_EQ(json::parse(to_json(report))["tables"][2]["mistake"]["name"], "mip-mapped");
}

TEST_F(CheckedFolder, MissingFile_IsAnErrorThatNamesIt) {
  const std::string folder = write_as("exr");
  fs::remove(folder + "/M.exr");
  const auto report = check_folder(folder);
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(report.error().message, testing::HasSubstr("M.exr"));
}

struct Wrong {
  const char* pointer;  ///< what is replaced
  json value;           ///< null: removed
  const char* message;
};

TEST(Manifest, WrongKey_IsRefusedByName) {
  const Wrong wrongs[] = {
      {"/schema_version", 99, "schema_version is 99"},
      {"/color_space", "sRGB", "color_space is \"sRGB\""},
      {"/origin", nullptr, "the key 'origin' is missing"},
      {"/format", "jpeg", "format is \"jpeg\""},
      {"/tables", json::array(), "tables is []"},
      {"/tables/0/file", "../M.exr", "tables[0].file"},
      {"/tables/1/name", "", "tables[1].name"},
      {"/tables/1/size/0", 0, "tables[1].size[0] is 0"},
      {"/tables/1/u/scale", "one", "tables[1].u.scale is \"one\""},
      {"/tables/1/v/address_mode", "repeat", "tables[1].v.address_mode"},
      {"/tables/1/channels/2/scale", 0, "tables[1].channels[2].scale is 0"},
      {"/tables/1/probes/3/values", {1, 2}, "tables[1].probes[3].values"},
      {"/tables/1/probes/3/u", 1.5, "tables[1].probes[3].u is 1.5"},
      {"/tables/2/probes", nullptr, "tables[2]: the key 'probes' is missing"},
      {"/terms", 3, "terms is 3"},
  };
  for (const Wrong& wrong : wrongs) {
    json text = json::parse(manifest_text("exr"));
    const json::json_pointer at(wrong.pointer);
    if (wrong.value.is_null())
      text[at.parent_pointer()].erase(at.back());
    else
      text[at] = wrong.value;
    const auto read = parse_manifest(text.dump(), "manifest.json");
    ASSERT_FALSE(read.ok()) << wrong.pointer;
    EXPECT_EQ(read.error().kind, ErrorKind::bad_input);
    EXPECT_THAT(read.error().message, testing::HasSubstr(std::string("manifest.json: ") + wrong.message));
  }
}

TEST(Manifest, TextThatIsNoJson_IsRefused) {
  for (const char* text : {"", "{", "[1,", "nonsense"}) EXPECT_FALSE(parse_manifest(text, "manifest.json").ok());
}

}  // namespace
}  // namespace cuticle::lut::check::lut_check_test
