// The snippets on the device against the tables as the CPU samples them.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>
#include <glm/geometric.hpp>

#include "core/file.h"
#include "gpu/device.h"
#include "gpu/tests/test_device.h"
#include "lut/evaluate.h"
#include "lut/format.h"
#include "lut/snippets/snippet.h"

namespace cuticle::lut::lut_snippet_gpu_test {
namespace {

namespace fs = std::filesystem;

using tests::device;

TableSet stored_set(std::string_view layout, const char* format, const char* model_name = "marschner",
                    const char* settings = "eta=1.55,sigma_a=0.1/0.2/0.4") {
  const bsdf::Model& model = *bsdf::find_model(model_name).value();
  const auto values = registry::parse_assignments(model.entry.parameters, settings).value();
  TableSet set = bake(model, values, *find_layout(layout).value(), 32, silent_progress()).value();
  EXPECT_TRUE(store_as(set, *find_format(format).value()).ok());
  return set;
}

Manifest manifest_of(const TableSet& set, const char* format) {
  return parse_manifest(manifest_json(set, *find_format(format).value()), "manifest.json").value();
}

/// A compute shader around the snippet: three vectors in, S and the probes' code out.
std::string glsl_shader(const Manifest& manifest) {
  std::string text =
      "#version 450\nlayout(local_size_x = 1) in;\n"
      "layout(std430, binding = 0) readonly buffer Given { vec4 given[]; };\n"
      "layout(std430, binding = 1) writeonly buffer Found { vec4 found[]; };\n";
  for (std::size_t t = 0; t < manifest.tables.size(); ++t)
    text += fmt::format("layout(binding = {}) uniform sampler2D cuticle_{};\n", t + 2, manifest.tables[t].name);
  text += snippets::snippet(manifest, *snippets::find_dialect("glsl").value()).value();
  return text +
         "void main() { uint i = gl_GlobalInvocationID.x; found[i] = vec4(cuticle_hair_scattering(given[3 * i].xyz, "
         "given[3 * i + 1].xyz, given[3 * i + 2].xyz), float(cuticle_verify_probes())); }\n";
}

/// Each texture has a sampler at its own binding, so that spirv-opt can join the two.
std::string hlsl_shader(const Manifest& manifest) {
  std::string text =
      "[[vk::binding(0)]] StructuredBuffer<float4> given;\n[[vk::binding(1)]] RWStructuredBuffer<float4> found;\n"
      "#define CUTICLE_SAMPLE(table, uv) table.SampleLevel(table##_sampler, uv, 0)\n";
  for (std::size_t t = 0; t < manifest.tables.size(); ++t)
    text += fmt::format(
        "[[vk::binding({0})]] Texture2D<float4> cuticle_{1};\n"
        "[[vk::binding({0})]] SamplerState cuticle_{1}_sampler;\n",
        t + 2, manifest.tables[t].name);
  text += snippets::snippet(manifest, *snippets::find_dialect("hlsl").value()).value();
  return text +
         "[numthreads(1, 1, 1)] void main(uint3 id : SV_DispatchThreadID) { uint i = id.x; found[i] = "
         "float4(cuticle_hair_scattering(given[3 * i].xyz, given[3 * i + 1].xyz, given[3 * i + 2].xyz), "
         "float(cuticle_verify_probes())); }\n";
}

class SnippetOnDevice : public testing::Test {
 protected:
  SnippetOnDevice() : folder_(fs::temp_directory_path() / fmt::format("cuticle_snippet_{}", ::getpid())) {
    fs::create_directories(folder_);
  }
  ~SnippetOnDevice() override { fs::remove_all(folder_); }
  std::string path(const char* name) const { return (folder_ / name).string(); }

  std::vector<std::uint32_t> spirv_file(const char* name) const {
    const std::vector<std::byte> bytes = read_file(path(name)).value();
    std::vector<std::uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), words.size() * 4);
    return words;
  }
  void run_tool(const std::string& command) const { ASSERT_EQ(std::system((command + " >&2").c_str()), 0) << command; }

  std::vector<std::uint32_t> compiled_glsl(const Manifest& manifest) {
    EXPECT_TRUE(write_text_file(path("s.comp"), glsl_shader(manifest)).ok());
    run_tool(
        fmt::format("{} -V --quiet --target-env vulkan1.3 -o {} {}", CUTICLE_GLSLANG, path("s.spv"), path("s.comp")));
    return spirv_file("s.spv");
  }
  std::vector<std::uint32_t> compiled_hlsl(const Manifest& manifest) {
    EXPECT_TRUE(write_text_file(path("s.hlsl"), hlsl_shader(manifest)).ok());
    run_tool(fmt::format("{} -D -V --quiet --target-env vulkan1.0 -S comp -e main -o {} {}", CUTICLE_GLSLANG,
                         path("h.spv"), path("s.hlsl")));
    std::string pairs;
    for (std::size_t t = 0; t < manifest.tables.size(); ++t) pairs += fmt::format(" 0:{}", t + 2);
    run_tool(fmt::format("spirv-opt --target-env=vulkan1.0 '--convert-to-sampled-image={}' {} -o {}", pairs.substr(1),
                         path("h.spv"), path("j.spv")));
    return spirv_file("j.spv");
  }
  fs::path folder_;
};

/// The stored numbers, without their scale, in a texture of the format's own precision.
gpu::Texture raw_texture(const Table& table, gpu::TextureFormat format) {
  const glm::ivec2 size{table.image.width, table.image.height};
  gpu::Texture texture = device()->make_texture({.size = size, .format = format}).value();
  std::vector<float> texels;
  for (int y = 0; y < table.image.height; ++y)
    for (int x = 0; x < table.image.width; ++x)
      for (int c = 0; c < 4; ++c) texels.push_back(c < table.image.channels() ? table.image.at(x, y, c) : 1.0F);
  EXPECT_TRUE(device()->upload(texture, texels).ok());
  return texture;
}

std::vector<glm::vec4> run_shader(const std::vector<std::uint32_t>& spirv, const TableSet& set,
                                  const std::vector<glm::vec4>& given,
                                  gpu::TextureFormat format = gpu::TextureFormat::rgba16f) {
  std::vector<gpu::Texture> textures;
  for (const Table& table : set.tables) textures.push_back(raw_texture(table, format));
  const gpu::Kernel kernel =
      device()->make_kernel(spirv, {.storage_buffers = 2, .textures = std::uint32_t(textures.size())}).value();
  const gpu::Buffer in = gpu::make_buffer_from<glm::vec4>(*device(), given).value();
  const gpu::Buffer out = device()->make_buffer(given.size() / 3 * sizeof(glm::vec4)).value();
  gpu::Commands commands = device()->record();
  const auto groups = std::uint32_t(given.size() / 3);
  std::vector<const gpu::Texture*> bound;
  for (const gpu::Texture& texture : textures) bound.push_back(&texture);
  commands.dispatch(kernel, std::vector<const gpu::Buffer*>{&in, &out}, bound, {}, groups);
  const auto done = device()->submit(std::move(commands));
  EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.error().message);
  return gpu::read_buffer<glm::vec4>(*device(), out, given.size() / 3).value();
}

/// Light, eye and tangent of random geometries, grazing ones among them.
std::vector<glm::vec4> directions(int count) {
  std::mt19937 generator(4);
  std::normal_distribution<float> normal;
  std::vector<glm::vec4> found;
  for (int i = 0; i < 3 * count; ++i) {
    const glm::dvec3 direction(normal(generator), normal(generator), normal(generator));
    found.emplace_back(glm::vec3(glm::normalize(direction)), 0);
  }
  return found;
}

double read_channel(const TableSet& set, const std::string& name, const bsdf::Point& at) {
  for (const Table& table : set.tables)
    for (std::size_t c = 0; c < table.layout->channels.size(); ++c)
      if (table.layout->channels[c].name == name)
        return sample(table, int(c), axis_coordinate(table.layout->u, set.size, at, table.caustic_index),
                      axis_coordinate(table.layout->v, set.size, at)) *
               left_out_factor(*table.layout, at, table.caustic_index);
  return -1;
}

bsdf::Point point_of(const glm::vec4* given) {
  const glm::dvec3 light(given[0]), eye(given[1]), tangent(given[2]);
  const double sine_i = glm::dot(light, tangent), sine_o = glm::dot(eye, tangent);
  const double cosines = std::sqrt((1 - sine_i * sine_i) * (1 - sine_o * sine_o));
  bsdf::Point point{.theta_i = std::asin(sine_i), .theta_o = std::asin(sine_o)};
  point.phi = std::acos(std::clamp((glm::dot(light, eye) - sine_i * sine_o) / cosines, -1.0, 1.0));
  point.theta_d = std::abs(point.theta_o - point.theta_i) / 2;
  return point;
}

/// S from the stored tables; where one holds cos theta_d, the others are read at that.
glm::dvec3 decoded_on_cpu(const TableSet& set, const glm::vec4* given) {
  bsdf::Point at = point_of(given);
  if (const double stored = read_channel(set, "cos_theta_d", at); stored >= 0) at.theta_d = std::acos(stored);
  glm::dvec3 sum(0);
  for (int c = 0; c < 3; ++c)
    for (const Term& term : set.layout->terms) {
      double product = 1;
      for (const std::string_view factor : term.factors) {
        if (factor.empty()) continue;
        const double grey = read_channel(set, std::string(factor), at);
        product *= grey >= 0 ? grey : read_channel(set, fmt::format("{}.{}", factor, "rgb"[c]), at);
      }
      sum[c] += product;
    }
  return set.layout->over_cos2_theta_d ? sum / std::max(std::pow(std::cos(at.theta_d), 2), 1e-6) : sum;
}

constexpr double k_half_step = 1.0 / 1024;

void expect_agreement(const TableSet& set, const std::vector<glm::vec4>& found, const std::vector<glm::vec4>& given,
                      double bound = 1.5 * k_half_step) {
  double largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double wanted = decoded_on_cpu(set, &given[3 * i])[c];
      largest = std::max(largest, std::abs(double(found[i][c]) - wanted) / (std::abs(wanted) + 0.01));
    }
  testing::Test::RecordProperty("largest", std::to_string(largest));
  EXPECT_LT(largest, bound);
}

TEST_F(SnippetOnDevice, Glsl_AgreesWithTheCpuToHalfPrecision) {
  using gpu::TextureFormat;
  for (const auto& [format, texels] : {std::pair{"exr", TextureFormat::rgba16f}, {"png16", TextureFormat::rgba32f}}) {
    const TableSet set = stored_set("nalu", format);
    const auto given = directions(256);
    const auto found = run_shader(compiled_glsl(manifest_of(set, format)), set, given, texels);
    expect_agreement(set, found, given);
    EXPECT_EQ(found[0].w, 0) << format;
  }
}

/// The driver filters such textures in 8 bits.
TEST_F(SnippetOnDevice, EightBitsWithScales_AgreeWithTheCpuToTheirSteps) {
  const TableSet set = stored_set("nalu", "png8");
  const auto given = directions(256);
  const auto found = run_shader(compiled_glsl(manifest_of(set, "png8")), set, given, gpu::TextureFormat::rgba8);
  double largest = 0, farthest = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double wanted = decoded_on_cpu(set, &given[3 * i])[c];
      largest = std::max(largest, wanted);
      farthest = std::max(farthest, std::abs(double(found[i][c]) - wanted));
    }
  EXPECT_LT(farthest / largest, 0.06);
  EXPECT_EQ(found[0].w, 0);
}

TEST_F(SnippetOnDevice, AnyLayoutOfTheModel_AgreesWithTheCpu) {
  for (const char* name : {"nalu2", "nalu_borders", "nalu_theta", "nalu_caustic", "barbu", "realengine"}) {
    const TableSet set = stored_set(name, "exr");
    const auto given = directions(64);
    const auto found = run_shader(compiled_glsl(manifest_of(set, "exr")), set, given);
    SCOPED_TRACE(name);
    // The arc functions of a device may be coarse: 1e-4 radians here.
    const bool over_angles = std::string_view(name) == "nalu_theta" || std::string_view(name) == "nalu_caustic";
    expect_agreement(set, found, given, over_angles ? 4 * k_half_step : 1.5 * k_half_step);
    EXPECT_EQ(found[0].w, 0);
  }
}

/// Their axes are of both directions, by more arc functions. Measured: .0039.
TEST_F(SnippetOnDevice, LayoutOfOneModel_AgreesWithTheCpu) {
  for (const auto& [layout, model] : {std::pair{"karis", "karis"}, {"half_vector", "scheuermann"}}) {
    const TableSet set = stored_set(layout, "exr", model, "");
    const auto given = directions(64);
    const auto found = run_shader(compiled_glsl(manifest_of(set, "exr")), set, given);
    SCOPED_TRACE(layout);
    expect_agreement(set, found, given, 5 * k_half_step);
    EXPECT_EQ(found[0].w, 0);
  }
}

TEST_F(SnippetOnDevice, Hlsl_AgreesWithTheCpuToHalfPrecision) {
  const TableSet set = stored_set("nalu", "exr");
  const auto given = directions(256);
  const auto found = run_shader(compiled_hlsl(manifest_of(set, "exr")), set, given);
  expect_agreement(set, found, given);
  EXPECT_EQ(found[0].w, 0);
}

TEST_F(SnippetOnDevice, ProbesOfATableThatIsUpsideDown_NameTableAndProbe) {
  TableSet set = stored_set("nalu", "exr");
  const auto spirv = compiled_glsl(manifest_of(set, "exr"));
  Image& image = set.tables[1].image;
  const Image right = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels(); ++c) image.at(x, y, c) = right.at(x, image.height - 1 - y, c);
  const float code = run_shader(spirv, set, directions(1))[0].w;
  EXPECT_GT(code, 200);
  EXPECT_LE(code, 210);
}

}  // namespace
}  // namespace cuticle::lut::lut_snippet_gpu_test
