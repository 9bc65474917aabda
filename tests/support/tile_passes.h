#pragma once
// The tile passes on one device, frame after frame, from coloured strands to the picture.
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/gtc/packing.hpp>

#include "render/pass_gpu.h"
#include "render/passes/lines/lines.h"
#include "render/passes/shade_strands/shade_strands_gpu.h"
#include "render/passes/tile_lists/tile_lists.h"
#include "render/passes/tile_lists/tile_lists_gpu.h"
#include "render/passes/tile_sort/tile_sort.h"
#include "render/passes/tiles/tiles.h"
#include "tests/support/drawn_strands.h"

namespace cuticle::tests {

struct Drawn {
  Image color;
  std::vector<float> depth;  ///< of the depth target
  std::vector<std::string> notes;
  std::vector<bool> seen;  ///< per vertex
  int attempts = 0;
  float alpha(int x, int y) const { return color.at(x, y, 3); }
};

class Tiles {
 public:
  explicit Tiles(const Drawing& drawing)
      : color_(target(drawing.camera().resolution, gpu::TextureFormat::rgba32f)),
        depth_(target(drawing.camera().resolution, gpu::TextureFormat::depth32f)),
        vertices_(upload(drawing.vertices)),
        segments_(upload(drawing.segments)),
        tangents_(upload(std::vector<glm::vec4>(drawing.vertices.size(), glm::vec4(0, 1, 0, 0)))) {
    std::vector<std::uint64_t> halves;
    for (const glm::vec4& color : drawing.colors) halves.push_back(glm::packHalf4x16(color));
    colors_ = upload(halves);
    resources_.edit<render::FrameView>().camera = drawing.camera();
    resources_.edit<render::DrawnHair>().strands = {
        &vertices_, &segments_, std::uint32_t(drawing.vertices.size()), std::uint32_t(drawing.segments.size()), {}};
    resources_.edit<render::DrawnHair>().tangents = &tangents_;
    resources_.edit<render::shade_strands::StrandColors>().values = &colors_;
    resources_.edit<render::DrawnHair>().vertices_per_strand = drawing.vertices_per_strand;
    resources_.edit<render::DrawnHair>().segment_parts = drawing.segment_parts;
    resources_.edit<render::Targets>().color = resources_.edit<render::Targets>().resolved = &color_;
    resources_.edit<render::Targets>().depth = &depth_;
    resources_.edit<render::Targets>().supersampling = 1;
    resources_.edit<render::Targets>().keep = drawing.has_scene;
    set(render::lines::entry(), "tip_variation", 0.0);
    set(render::tile_sort::entry(), "slices", drawing.slices);
    set(render::tiles::entry(), "opacity", drawing.opacity);
    resources_.parameters["tiles"].set("coverage_rows", drawing.coverage_rows);
    set(render::tile_lists::entry(), "budget_mib", drawing.budget_mib);
    resources_.parameters["tile_lists"].set("full_px", drawing.full_px);
    resources_.parameters["tile_lists"].set("lanes", drawing.lanes);
    resources_.parameters["tile_lists"].set("whole_segments", drawing.segment_parts > 1);
    resources_.edit<render::DrawnHair>().strands.bounds = {{-4, -4, -1}, {4, 4, 1}};
    scene_ = std::vector<float>(std::size_t(drawing.size * drawing.size), drawing.scene_depth);
    for (std::size_t side = std::size_t(drawing.size), last = side - 1; drawing.has_gap && last < scene_.size();
         last += side)
      scene_[last] = 1;
    for (std::string_view name : {"tile_lists", "tile_sort", "tiles"}) make(name);
  }

  Drawn draw() {
    Drawn drawn;
    for (bool holds = false; !holds; ++drawn.attempts) {
      submit();
      holds = settle(drawn.notes);
    }
    drawn.color = make_image(color_.size().x, color_.size().y, {"R", "G", "B", "A"});
    drawn.color.pixels = *device()->download(color_);
    drawn.depth = *device()->download(depth_);
    const gpu::Buffer& visible = resources_.get<render::tile_lists::TileLists>().visible;
    const auto words = *gpu::read_buffer<std::uint32_t>(*device(), visible, visible.size() / 4);
    for (std::uint32_t v = 0; v < resources_.get<render::DrawnHair>().strands.vertex_count; ++v)
      drawn.seen.push_back((words[v / 32] >> v % 32 & 1) != 0);
    return drawn;
  }

 private:
  void set(const render::Pass& pass, std::string_view name, registry::Value value) {
    registry::ParameterValues values = registry::default_values(pass.entry.parameters);
    values.set(name, std::move(value));
    resources_.parameters[std::string(pass.entry.name)] = values;
  }
  void make(std::string_view name) {
    for (const render::GpuPassEntry* entry : render::gpu_passes()) {
      if (entry->name != name) continue;
      auto pass = entry->create(device(), resources_);
      ASSERT_TRUE(pass) << pass.error().message;
      (*pass)->publish(resources_);
      passes_.push_back(std::move(*pass));
    }
  }
  void submit() {
    if (resources_.get<render::Targets>().keep) {
      EXPECT_TRUE(device()->upload(depth_, scene_));
      EXPECT_TRUE(device()->upload(color_, std::vector<float>(4 * scene_.size(), 0.0f)));
    }
    gpu::Commands commands = device()->record();
    for (const auto& pass : passes_) EXPECT_TRUE(pass->record(commands, resources_));
    const auto cost = device()->submit(std::move(commands));
    ASSERT_TRUE(cost) << cost.error().message;
  }
  bool settle(std::vector<std::string>& notes) {
    bool holds = true;
    for (const auto& pass : passes_) {
      const auto settled = pass->settle();
      EXPECT_TRUE(settled) << (settled ? "" : settled.error().message);
      if (!settled) return true;
      holds = holds && settled->holds;
      notes.insert(notes.end(), settled->notes.begin(), settled->notes.end());
    }
    return holds;
  }

  gpu::Texture color_, depth_;
  gpu::Buffer vertices_, segments_, tangents_, colors_;
  std::vector<float> scene_;
  render::Resources resources_;
  std::vector<std::unique_ptr<render::GpuPass>> passes_;
};

inline Drawn draw(const Drawing& drawing) { return Tiles(drawing).draw(); }

}  // namespace cuticle::tests
