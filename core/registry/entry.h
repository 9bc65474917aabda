#pragma once
// What a model, layout, method, effect or pass says about itself. The CLI, docs, schema, plan and studies walk these.
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/registry/parameter.h"

namespace cuticle::registry {

enum class EntryKind { model, layout, method, effect, pass };

/// Where a pass stands in a frame; the plan sorts by stage, then by name.
enum class Stage { prepare, simulate, generate, shadow, shade, resolve, output };

/// A case of a study: the settings of one point on an error-against-time curve, as `--set` would take them.
struct StudyCase {
  std::string_view name;
  std::string_view settings;
};

/// Sizes of a frame, from which entries say how many dispatches they will make: what a plan prints and a run must equal.
struct FrameShape {
  std::uint32_t control_strands = 0, control_vertices = 0;  ///< simulated
  std::uint32_t strands = 0, vertices = 0, segments = 0;    ///< drawn
  std::uint32_t substeps = 1;
  std::uint32_t lights = 0;
  std::uint64_t max_storage_buffer_bytes = 134217728;
};

struct Entry {
  EntryKind kind = EntryKind::model;
  std::string_view name;
  std::string_view summary;
  std::string_view source;                            ///< paper or system, with equation or section
  ParameterTable parameters = {};
  std::span<const std::string_view> demands = {};     ///< facts that must ALL hold for this to run ("light", "colliders")
  Stage stage = Stage::prepare;
  std::span<const std::string_view> systems = {};     ///< rows of systems.md ("N12")
  std::span<const StudyCase> study_cases = {};
  /// Compute dispatches per frame for these parameters, and draws per frame; null = none.
  std::uint32_t (*dispatches)(const ParameterValues& values, const FrameShape& shape) = nullptr;
  std::uint32_t draws = 0;
  std::span<const std::string_view> after = {};       ///< entries of the same stage that run before this one, when they run
};

/// A fact of a scene: whether it holds, and the words for it ("2 sphere colliders", "the scene has no light").
struct Fact {
  bool holds = false;
  std::string why;
};
using Facts = std::map<std::string, Fact, std::less<>>;

/// Whether an entry's demands are met, with the reason: all facts that hold, or the first that does not.
struct Verdict {
  bool demanded = false;
  std::string reason;
};
Verdict judge(const Entry& entry, const Facts& facts);

/// Entries as a JSON array: name, summary, source, parameters (unit, range, default), demands, stage, systems.
std::string to_json(std::span<const Entry* const> entries);
/// The same as an aligned text table.
std::string to_text(std::span<const Entry* const> entries);

}  // namespace cuticle::registry
