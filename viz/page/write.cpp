#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/core.h>

#include "bsdf/model.h"
#include "core/file.h"
#include "lut/format.h"
#include "lut/snippets/snippet.h"
#include "lut/table_set.h"
#include "lut/target.h"
#include "viz/page/page.h"

namespace cuticle::viz::page {
namespace {

namespace fs = std::filesystem;

/// Strands that cover a head as they are, and how much fewer ones are drawn wider at first.
constexpr std::size_t k_full_head = 40000;
constexpr double k_max_widening = 12;

/// The package three of npm.
Result<std::string> three_folder(const PageRequest& request) {
  std::vector<fs::path> places;
  if (!request.three.empty()) places.emplace_back(request.three);
  if (const char* named = std::getenv("CUTICLE_THREE"); request.three.empty() && named) places.emplace_back(named);
  if (request.three.empty()) {
    std::error_code failed;
    for (fs::path folder = fs::current_path(failed); !folder.empty(); folder = folder.parent_path()) {
      places.push_back(folder / "node_modules/three");
      if (folder == folder.parent_path()) break;
    }
    if (!request.also.empty()) places.push_back(fs::path(request.also) / "three");
  }
  for (const fs::path& place : places)
    if (fs::exists(place / "build/three.module.js")) return place.string();
  return bad_input(request.three.empty() ? "three.js was not found: the page is made with it"
                                         : fmt::format("{}: holds no build/three.module.js", request.three),
                   "npm install three@0.187.0 here, or name its folder with --three");
}

/// Every so many strands, as much wider as they are fewer.
strands::Groom thinned(const strands::Groom& groom, std::size_t most) {
  if (groom.strand_count() <= most) return groom;
  strands::Groom kept;
  const double step = double(groom.strand_count()) / double(most);
  for (std::size_t k = 0; k < most; ++k) {
    const auto s = std::size_t(double(k) * step);
    const std::uint32_t first = groom.offsets[s], last = groom.offsets[s + 1];
    kept.positions.insert(kept.positions.end(), groom.positions.begin() + first, groom.positions.begin() + last);
    for (std::uint32_t v = first; v < last; ++v) kept.radii.push_back(groom.radii[v] * float(step));
    kept.offsets.push_back(std::uint32_t(kept.positions.size()));
  }
  return kept;
}

/// The functions that read the tables, as `cuticle bake --target three` writes them.
Result<std::string> snippet_of(const bsdf::Model& model, const registry::ParameterValues& values, Progress& progress) {
  CUTICLE_ASSIGN(const lut::Layout* layout, lut::find_layout("nalu_theta", model, values));
  CUTICLE_ASSIGN(const lut::Format* format, lut::find_format("exr"));
  CUTICLE_ASSIGN(lut::TableSet set, lut::bake(model, values, *layout, 128, progress));
  CUTICLE_TRY(lut::certify(set, *format, progress));
  CUTICLE_ASSIGN(const lut::Manifest manifest, lut::parse_manifest(lut::manifest_json(set, *format), "manifest"));
  CUTICLE_ASSIGN(const lut::snippets::Dialect* glsl, lut::snippets::find_dialect("glsl"));
  return lut::engine_snippet(manifest, "glsl", lut::snippets::declarations(manifest, *glsl));
}

/// Whether it is the corrected model of a round fibre with its exact caustic.
Result<void> check_model(const bsdf::marschner::Parameters& p) {
  using namespace bsdf::marschner;
  if (p.variant == Variant::corrected && p.caustic == CausticKind::exact && p.aspect == 1 &&
      p.attenuation_angle == AttenuationAngle::theta_d)
    return {};
  return usage_error("the viewer shows variant=corrected, caustic=exact, attenuation_angle=theta_d, aspect=1",
                     "leave them out of --set");
}

}  // namespace

Result<void> check_page(const PageRequest& request) {
  CUTICLE_TRY(check_model(request.model));
  CUTICLE_TRY(three_folder(request));
  return {};
}

Result<void> write_page(const PageRequest& request, const std::string& folder, Progress& progress) {
  CUTICLE_TRY(check_model(request.model));
  CUTICLE_ASSIGN(const std::string three, three_folder(request));
  CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model("marschner"));
  CUTICLE_ASSIGN(const std::string snippet, snippet_of(*model, registry::to_values(request.model), progress));
  // A groom of guides alone would be too thin to look at.
  const double widen =
      std::clamp(std::round(double(k_full_head) / double(request.groom.strand_count())), 1.0, k_max_widening);
  const strands::Groom shown = thinned(request.groom, request.strands);
  const std::size_t all = request.groom.strand_count(), some = shown.strand_count();
  const std::string words =
      some == all ? fmt::format("{} strands", all) : fmt::format("{} of {} strands, as much wider", some, all);
  CUTICLE_ASSIGN(const std::string page, index_page(three, snippet, request.title));
  CUTICLE_TRY(make_folder(folder));
  CUTICLE_TRY(write_text_file(folder + "/hair.js",
                              hair_script(shown, request.head, request.model, request.title, words, widen)));
  return write_text_file(folder + "/index.html", page);
}

}  // namespace cuticle::viz::page
