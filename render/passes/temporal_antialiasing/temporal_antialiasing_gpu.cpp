#include <algorithm>

#include "render/passes/temporal_antialiasing/temporal_antialiasing.h"
#include "render/passes/velocity/velocity_gpu.h"
#include "render/picture_filter_gpu.h"

#include <temporal_antialiasing_comp.spv.h>

namespace cuticle::render::temporal_antialiasing {

namespace {

struct Push {
  glm::uvec2 resolution;
  float share, spread;
};

/// Digits of the index mirrored at the point: 0 .. 1.
double radical_inverse(std::uint32_t index, std::uint32_t base) {
  double value = 0, digit = 1;
  for (; index > 0; index /= base) value += (digit /= base) * (index % base);
  return value;
}

glm::dvec2 halton(std::uint32_t index) { return {radical_inverse(index, 2), radical_inverse(index, 3)}; }

/// Camera::pixel_shift of the frame, -.51 .. .51 pixels: one after another of the pass's `frames` points of Halton's
/// sequence in bases 2 and 3 (1960), about their own middle, so that their mean is no shift, beginning anew after a
/// cut.
glm::dvec2 pixel_shift(std::uint32_t frames_since_cut, std::uint32_t frames) {
  glm::dvec2 middle(0);
  for (std::uint32_t index = 1; index <= frames; ++index) middle += halton(index) / double(frames);
  return halton(1 + (frames_since_cut - 1) % frames) - middle;
}

class TemporalAntialiasing : public GpuPass {
 public:
  TemporalAntialiasing(PictureFilter filter, gpu::Buffer history)
      : filter_(std::move(filter)), history_(std::move(history)) {}

  void change_view(FrameView& view, const PassParameters& parameters) const override {
    view.camera.pixel_shift = pixel_shift(view.frames_since_cut, parameters_of<Parameters>(parameters).frames);
  }

  Result<void> record(gpu::Commands& commands, const Resources& resources) override {
    const FrameView& view = resources.get<FrameView>();
    // A frame that is drawn once more, because a buffer was too small, has the
    // same number and the same past.
    if (view.frames_since_cut > 1 && view.frames_since_cut != recorded_)
      commands.copy(filter_.picture(), history_, history_.size());
    recorded_ = view.frames_since_cut;
    const auto parameters = parameters_of<Parameters>(resources);
    const std::uint32_t frames = parameters.frames;
    const Push push{glm::uvec2(view.camera.resolution), 1.0f / float(std::clamp(recorded_, 1u, frames)),
                    float(parameters.spread)};
    const gpu::Buffer* const own[] = {resources.get<velocity::MotionVectors>().values, &history_};
    filter_.record(commands, resources, gpu::bytes_of(push), own);
    return {};
  }

 private:
  PictureFilter filter_;
  gpu::Buffer history_;
  std::uint32_t recorded_ = 0;
};

Result<std::unique_ptr<GpuPass>> create(std::shared_ptr<gpu::Device> device, const Resources& resources) {
  CUTICLE_ASSIGN(PictureFilter filter,
                 PictureFilter::create(*device, temporal_antialiasing_comp,
                                       resources.get<FrameView>().camera.resolution, sizeof(Push), 2));
  CUTICLE_ASSIGN(gpu::Buffer history, device->make_buffer(filter.picture().size()));
  return std::unique_ptr<GpuPass>(std::make_unique<TemporalAntialiasing>(std::move(filter), std::move(history)));
}

}  // namespace

const GpuPassEntry& gpu_entry() {
  static const GpuPassEntry table{"temporal_antialiasing", create};
  return table;
}

}  // namespace cuticle::render::temporal_antialiasing
