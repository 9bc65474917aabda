#include "render/reference/tracer.h"

#include <fmt/core.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include "render/reference/wave.h"

namespace cuticle::render::reference {

struct Tracer::Parts {
  TracedScene scene;
  WaveScene wave;
  tbb::enumerable_thread_specific<Wave> waves{[this] { return Wave(wave); }};  ///< whose arrays are used again
};

namespace {

/// The field asked for, of a model that has both.
registry::ParameterValues of_field(const bsdf::Model& model, registry::ParameterValues values, bool far) {
  for (const registry::Parameter& parameter : model.entry.parameters)
    if (parameter.name == "field") values.set("field", std::string(far ? "far" : "near"));
  return values;
}

}  // namespace

std::vector<std::string> split_names(const bsdf::Model& model) {
  std::vector<std::string> names = {"scatterings_1",     "scatterings_2",     "scatterings_3", "scatterings_4_7",
                                    "scatterings_8_15",  "scatterings_16_on", "single",        "multiple_forward",
                                    "multiple_backward", "multiple_other"};
  for (int lobe = 0; lobe < k_max_lobes; ++lobe)
    names.push_back(std::size_t(lobe) < model.lobes.size() ? "lobe_" + std::string(model.lobes[std::size_t(lobe)])
                                                           : std::string());
  return names;
}

Tracer::Tracer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Tracer::~Tracer() = default;

Result<std::unique_ptr<Tracer>> Tracer::make(const TracedScene& scene, const TraceOptions& options) {
  if (!scene.model->sample_f32)
    return usage_error(fmt::format("model {} has no sampler, which paths need", scene.model->entry.name));
  auto parts = std::make_unique<Parts>();
  parts->scene = scene;
  parts->scene.values = of_field(*scene.model, scene.values, options.far_field || options.tables);
  CUTICLE_TRY(parts->wave.build(parts->scene, options));
  return std::unique_ptr<Tracer>(new Tracer(std::move(parts)));
}

void Tracer::trace(std::span<const PathName> paths, std::span<PathLight> light, std::span<LightSplits> splits) const {
  CUTICLE_EXPECT(paths.size() == light.size(), "one light for each path");
  CUTICLE_EXPECT(splits.size() == (parts_->wave.options.layers ? paths.size() : 0), "splits where there are layers");
  tbb::this_task_arena::isolate([&] { parts_->waves.local().run(paths, light, splits); });
}

void Tracer::set_seed(std::uint64_t seed) { parts_->wave.options.seed = seed; }
const TracedScene& Tracer::scene() const { return parts_->scene; }
std::size_t Tracer::memory_bytes() const { return parts_->wave.rays->memory_bytes(); }

}  // namespace cuticle::render::reference
