// Strands as data: {"groom", "operation": "smooth" | "tangents" | "validate", "vertices"}. smooth gives coordinates, tangents their
// lengths, validate nothing.
#include <glm/geometric.hpp>

#include "core/json/json.h"
#include "strands/spline/smooth.h"
#include "tests/hard_cases/subject.h"
#ifdef CUTICLE_HAS_GPU
#include <glm/vec4.hpp>

#include "strands/spline/smooth_gpu.h"
#include "tests/hard_cases/gpu_session.h"
#endif

namespace cuticle::hard_cases {
namespace {

Values lengths(std::span<const glm::vec3> vectors) {
  Values values;
  for (const glm::vec3& v : vectors) values.push_back(double(glm::length(v)));
  return values;
}

}  // namespace

Result<Values> run_strands_f32(const Json& inputs, GpuSession*) {
  const strands::Groom groom = groom_from(inputs.at("groom"));
  CUTICLE_TRY(strands::validate(groom));
  const std::string operation = inputs.at("operation").text();
  if (operation == "smooth") return coordinates(strands::smooth(groom, inputs.at("vertices").get<int>()).positions);
  if (operation == "tangents") return lengths(strands::tangents(groom));
  return Values{};
}

#ifdef CUTICLE_HAS_GPU
namespace {

std::vector<glm::vec3> without_fourth(std::span<const glm::vec4> vectors) { return {vectors.begin(), vectors.end()}; }

/// Each control strand drawn as itself.
Result<std::unique_ptr<strands::StrandGenerator>> generated(const std::shared_ptr<gpu::Device>& device, const strands::Groom& groom,
                                                            int vertices) {
  std::vector<std::array<std::uint32_t, 3>> hairs;
  for (std::uint32_t s = 0; s < groom.strand_count(); ++s) hairs.push_back({s, s, s});
  const std::vector<glm::vec3> weights(hairs.size(), glm::vec3(0.25f, 0.25f, 0.5f));
  CUTICLE_ASSIGN(std::unique_ptr<strands::StrandGenerator> generator,
                 strands::StrandGenerator::create(device, {&groom, vertices, hairs, weights}));
  std::vector<glm::vec4> places;
  for (const glm::vec3& position : groom.positions) places.emplace_back(position, 0);
  CUTICLE_ASSIGN(const gpu::Buffer control, gpu::make_buffer_from<glm::vec4>(*device, places));
  gpu::Commands commands = device->record();
  CUTICLE_TRY(generator->record_smooth(commands, control));
  CUTICLE_TRY(generator->record_interpolate(commands));
  CUTICLE_TRY(device->submit(std::move(commands)));
  return generator;
}

}  // namespace

Result<Values> run_strands_gpu(const Json& inputs, GpuSession* session) {
  const strands::Groom groom = groom_from(inputs.at("groom"));
  CUTICLE_TRY(strands::validate(groom));
  const std::string operation = inputs.at("operation").text();
  if (operation == "validate") return Values{};
  CUTICLE_ASSIGN(const auto generator, generated(session->device, groom, inputs.value("vertices", 8)));
  const gpu::Buffer& buffer = operation == "smooth" ? generator->vertices() : generator->tangents();
  CUTICLE_ASSIGN(const std::vector<glm::vec4> vectors, gpu::read_buffer<glm::vec4>(*session->device, buffer, generator->vertex_count()));
  const std::vector<glm::vec3> spatial = without_fourth(vectors);
  return operation == "smooth" ? coordinates(spatial) : lengths(spatial);
}
#endif

}  // namespace cuticle::hard_cases
