#pragma once
// The concept of a render pass: one folder each, with its demands, its shader and its cost.
#include <algorithm>
#include <span>
#include <string_view>

#include "core/registry/entry.h"
#include "core/registry/members.h"
#include "core/result.h"
#include "render/resource.h"

namespace cuticle::render {

/// Parameters of passes by name, as a scene gives them; absent: defaults.
using PassParameters = std::map<std::string, registry::ParameterValues, std::less<>>;
/// Those of one pass, as its struct.
template <class Parameters>
Parameters parameters_of(const PassParameters& passes) {
  const auto found = passes.find(Parameters::name);
  return found == passes.end() ? Parameters{} : registry::from_values<Parameters>(found->second);
}

/// How a pass draws strands, for what looks at which of them show.
struct StrandDraw {
  double full_px = 0;           ///< level of detail: see visibility::drawn_part; 0: always all
  std::uint32_t corners = 0;    ///< vertices a segment; 0: strands become neither triangles nor lines
  double width_factor = 0;      ///< the greatest on a strand's own width
  bool of_one_width = false;    ///< drawn as wide as lines::line_width says, not by their own widths
  bool whole_segments = false;  ///< those that a scene cuts into parts are drawn as one
};
constexpr std::string_view resource_name(const StrandDraw*) { return "strand_draw"; }

/// What a pass wants of the targets that a frame is drawn into.
struct TargetShape {
  int supersampling = 2;  ///< texels across a pixel
  int samples = 1;        ///< multisampling, of those that the device offers
};

struct Pass {
  registry::Entry entry;
  std::span<const Use> uses = {};  ///< resources that it reads and writes
  bool whole_pictures = false;     ///< draws or looks at all of a picture at once, so that it cannot be drawn in chunks
  int (*chunk_px)(const PassParameters&) =
      nullptr;  ///< of a pass that draws in chunks: their side; 0: as large as may be
  /// Of a pass that draws strands: targets by its parameters, and by the sample counts that the device offers.
  TargetShape (*targets)(const PassParameters&, std::span<const int> offered) = nullptr;
  StrandDraw (*strand_draw)(const PassParameters&) = nullptr;
  /// Whether it asks the fibre model at the strands' vertices: by formulas that takes k_formula_dispatches a light.
  bool asks_model = false;
};
inline constexpr std::uint32_t k_formula_dispatches = 2;  ///< the angles, then the model
std::span<const Pass* const> passes();
/// The pass of that entry; null: the entry is none's.
inline const Pass* pass_of(const registry::Entry& entry) {
  const auto found = std::ranges::find(passes(), &entry, [](const Pass* each) { return &each->entry; });
  return found == passes().end() ? nullptr : *found;
}

inline Pass with_uses(Pass pass, std::span<const Use> uses) {
  pass.uses = uses;
  return pass;
}

}  // namespace cuticle::render
