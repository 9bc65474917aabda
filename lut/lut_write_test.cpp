// The files of a table set, read back.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "core/file.h"
#include "lut/format.h"
#include "lut/table_set.h"

namespace cuticle::lut::lut_write_test {
namespace {

namespace fs = std::filesystem;

class Written : public testing::Test {
 protected:
  Written() : folder_(fs::temp_directory_path() / ("cuticle_lut_" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
  }
  ~Written() override { fs::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  TableSet bake_and_write(const Format& format) {
    const bsdf::Model& model = *bsdf::find_model("marschner").value();
    const auto values = registry::parse_assignments(model.entry.parameters, "eta=1.5,sigma_a=0.1/0.2/0.3").value();
    TableSet set = bake(model, values, *find_layout("nalu").value(), 16, silent_progress()).value();
    EXPECT_TRUE(certify(set, format, silent_progress()).ok());
    EXPECT_TRUE(write(set, format, folder_.string()).ok());
    return set;
  }
  nlohmann::json manifest() const { return nlohmann::json::parse(read_text_file(path("manifest.json")).value()); }
  std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const auto& entry : fs::directory_iterator(folder_)) result.push_back(entry.path().filename().string());
    return result;
  }
  fs::path folder_;
};

TEST_F(Written, Exr_HoldsTheTablesTexelForTexel) {
  const TableSet set = bake_and_write(half_exr());
  for (const Table& table : set.tables) {
    const Image image = read_exr(path(file_name(table, half_exr()))).value();
    ASSERT_EQ(image.channels(), table.image.channels());
    for (int c = 0; c < image.channels(); ++c) {
      const auto position =
          std::find(image.channel_names.begin(), image.channel_names.end(), std::string(1, "RGBA"[c]));
      ASSERT_NE(position, image.channel_names.end());
      const int read = int(position - image.channel_names.begin());
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) ASSERT_EQ(image.at(x, y, read), table.image.at(x, y, c));
    }
  }
}

TEST_F(Written, ExrAttribute_IsTheManifest) {
  bake_and_write(half_exr());
  const auto attributes = read_exr_attributes(path("N_TRT.exr")).value();
  ASSERT_TRUE(attributes.contains("cuticle:manifest"));
  nlohmann::json without_digests = manifest();
  for (nlohmann::json& table : without_digests["tables"]) table.erase("sha256");
  EXPECT_EQ(nlohmann::json::parse(attributes.at("cuticle:manifest")), without_digests);
}

TEST_F(Written, Manifest_SaysWhatTheTablesAre) {
  const TableSet set = bake_and_write(half_exr());
  const nlohmann::json json = manifest();
  EXPECT_EQ(json["model"], "marschner");
  EXPECT_EQ(json["layout"], "nalu");
  EXPECT_EQ(json["color_space"], "data");
  EXPECT_EQ(json["origin"], "top_left");
  EXPECT_EQ(json["parameters"]["eta"], 1.5);
  EXPECT_EQ(json["tables"].size(), 3u);
  EXPECT_EQ(json["tables"][2]["channels"][0]["texel"], "cell average");
  EXPECT_EQ(json["tables"][0]["channels"][0]["unit"], "1/rad");
  EXPECT_EQ(json["tables"][0]["channels"][1]["error"]["maximum"].get<double>(), set.tables[0].errors[1].maximum);
  EXPECT_FALSE(json["tool_version"].get<std::string>().empty());
}

TEST_F(Written, ManifestsScaleAndBias_AddressTheTexels) {
  bake_and_write(half_exr());
  const nlohmann::json axis = manifest()["tables"][1]["v"];
  EXPECT_DOUBLE_EQ(0 * axis["scale"].get<double>() + axis["bias"].get<double>(), 0.5 / 16);
  EXPECT_DOUBLE_EQ(1 * axis["scale"].get<double>() + axis["bias"].get<double>(), 15.5 / 16);
}

TEST_F(Written, Probes_AreTheFilteredFilesValues) {
  const TableSet set = bake_and_write(half_exr());
  const nlohmann::json probes = manifest()["tables"][1]["probes"];
  ASSERT_EQ(probes.size(), 10u);
  EXPECT_EQ(probes[1]["values"][3].get<double>(), double(set.tables[1].image.at(15, 0, 3)));
  EXPECT_EQ(probes[2]["values"][0].get<double>(), double(set.tables[1].image.at(0, 15, 0)));
}

TEST_F(Written, Png16WithScale_GivesTheValuesBack) {
  const TableSet set = bake_and_write(*find_format("png16").value());
  const Image image = read_image(path("N_TT_R.png")).value();
  const double scale = manifest()["tables"][1]["channels"][0]["scale"];
  for (int x = 0; x < 16; ++x)
    EXPECT_NEAR(double(image.at(x, 9, 0)) * scale, double(set.tables[1].image.at(x, 9, 0)) * set.tables[1].scale[0],
                1e-6 * scale);
}

TEST_F(Written, Png8WithScale_GivesTheValuesBack) {
  const TableSet set = bake_and_write(*find_format("png8").value());
  const Image image = read_image(path("M.png")).value();
  const double scale = manifest()["tables"][0]["channels"][0]["scale"];
  for (int x = 0; x < 16; ++x)
    EXPECT_NEAR(double(image.at(x, 15 - x, 0)) * scale,
                double(set.tables[0].image.at(x, 15 - x, 0)) * set.tables[0].scale[0], 1e-6 * scale);
}

TEST_F(Written, Folder_HoldsTheFilesAndNothingElse) {
  bake_and_write(half_exr());
  EXPECT_THAT(names(), testing::UnorderedElementsAre("M.exr", "N_TT_R.exr", "N_TRT.exr", "manifest.json", "preview.png", "timings.json",
                                                     "cuticle_hair.glsl", "cuticle_hair.hlsl", "cuticle_hair.wgsl"));
}

TEST_F(Written, FolderThatCannotBe_IsAnErrorAndLeavesNothing) {
  fs::create_directories(folder_);
  std::ofstream(folder_ / "file") << "in the way";
  const TableSet set = bake(*bsdf::find_model("marschner").value(),
                            registry::default_values(bsdf::find_model("marschner").value()->entry.parameters),
                            *find_layout("nalu").value(), 16, silent_progress())
                           .value();
  const auto result = write(set, half_exr(), path("file/tables"));
  ASSERT_FALSE(result.ok());
  EXPECT_EQ(result.error().kind, ErrorKind::bad_input);
  EXPECT_THAT(result.error().message, testing::HasSubstr("file"));
  EXPECT_THAT(names(), testing::ElementsAre("file"));
}

TEST_F(Written, FileThatCannotBeReplaced_LeavesNoPartOfTheSetBehind) {
  fs::create_directories(folder_ / "M.exr" / "occupied");
  const bsdf::Model& model = *bsdf::find_model("marschner").value();
  const TableSet set =
      bake(model, registry::default_values(model.entry.parameters), *find_layout("nalu").value(), 16, silent_progress())
          .value();
  ASSERT_FALSE(write(set, half_exr(), folder_.string()).ok());
  EXPECT_THAT(names(), testing::ElementsAre("M.exr"));
}

}  // namespace
}  // namespace cuticle::lut::lut_write_test
