#include <fmt/core.h>

#include "cli/character_info.h"
#include "cli/groom_options.h"
#include "cli/usd_files.h"
#include "core/json/json.h"
#include "core/text.h"
#include "strands/refusals.h"
#include "strands/statistics.h"

namespace cuticle::cli {

namespace {

using strands::Spread;

Json to_json(const Spread& spread) {
  return {{"min", spread.least}, {"median", spread.median}, {"mean", spread.mean}, {"max", spread.greatest}};
}
Json to_json(const glm::vec3& v) { return {v.x, v.y, v.z}; }

Json to_json(const std::vector<strands::DegenerateStrand>& degenerate) {
  Json list = Json::list();
  for (const auto& strand : degenerate)
    list.push_back({{"strand", strand.strand},
                    {"coincident_segments", strand.coincident_segments},
                    {"has_length", strand.has_length}});
  return list;
}

Json to_json(const std::vector<strands::Refusal>& refusals) {
  Json list = Json::list();
  for (const auto& [engine, what] : refusals) list.push_back({{"engine", engine}, {"what", what}});
  return list;
}

/// What was mended; null where that was not asked for.
Json to_json(const std::optional<strands::Repairs>& repairs) {
  if (!repairs) return nullptr;
  return {{"points_not_finite", repairs->points_not_finite},
          {"coincident_points", repairs->coincident_points},
          {"strands_of_one_point", repairs->strands_of_one_point},
          {"strands_without_length", repairs->strands_without_length},
          {"points_added", repairs->points_added},
          {"values_replaced", repairs->values_replaced}};
}

Json to_json(const std::string& path, const strands::GroomFile& file, const strands::GroomStatistics& figures) {
  Json attributes = Json::list();
  for (const auto& [name, attribute] : file.groom.attributes) attributes.push_back(name);
  return {{"file", path},
          {"strands", figures.strands},
          {"vertices", figures.vertices},
          {"vertices_per_strand", {{"min", figures.least_vertices}, {"max", figures.greatest_vertices}}},
          {"length_m", to_json(figures.length)},
          {"segment_m", to_json(figures.segment)},
          {"radius_m", to_json(figures.radius)},
          {"spacing_m", figures.spacing},
          {"bounds_m", {{"lower", to_json(figures.bounds.lower)}, {"upper", to_json(figures.bounds.upper)}}},
          {"metres_per_unit", file.metres_per_unit},
          {"has_root_uv", !file.groom.root_uv.empty()},
          {"attributes", attributes},
          {"degenerate_strands", to_json(figures.degenerate)},
          {"refused_by", to_json(strands::refusals(file.groom))},
          {"repaired", to_json(file.repairs)},
          {"notes", file.notes}};
}

void print_spread(const char* name, const Spread& spread) {
  fmt::print("{:<22}{:.4g} .. {:.4g} m, median {:.4g}, mean {:.4g}\n", name, spread.least, spread.greatest,
             spread.median, spread.mean);
}

void print_degenerate(const std::vector<strands::DegenerateStrand>& degenerate) {
  constexpr std::size_t shown = 10;
  fmt::print("{:<22}{}\n", "degenerate strands", degenerate.size());
  for (std::size_t i = 0; i < std::min(shown, degenerate.size()); ++i)
    fmt::print("  strand {}: {} segments without length{}\n", degenerate[i].strand, degenerate[i].coincident_segments,
               degenerate[i].has_length ? "" : "; no length at all");
  if (degenerate.size() > shown) fmt::print("  and {} more (--json lists all)\n", degenerate.size() - shown);
}

void print_text(const strands::GroomFile& file, const strands::GroomStatistics& figures) {
  fmt::print("{:<22}{}\n", "strands", figures.strands);
  fmt::print("{:<22}{} ({} .. {} per strand)\n", "vertices", figures.vertices, figures.least_vertices,
             figures.greatest_vertices);
  print_spread("length", figures.length);
  print_spread("segment", figures.segment);
  print_spread("radius", figures.radius);
  fmt::print("{:<22}{:.4g} m between neighbouring fibres\n", "spacing", figures.spacing);
  std::string attributes = file.groom.root_uv.empty() ? "" : "root_uv ";
  for (const auto& [name, attribute] : file.groom.attributes) attributes += printable(name, 60) + " ";
  fmt::print("{:<22}{}\n", "attributes", attributes.empty() ? "none" : attributes);
  fmt::print("{:<22}{} metres per unit\n", "units", file.metres_per_unit);
  for (const std::string& note : file.notes) fmt::print("{:<22}{}\n", "note", printable(note));
  for (const auto& [engine, what] : strands::refusals(file.groom))
    fmt::print("{:<22}{}: {}\n", "refused by", engine, what);
  print_degenerate(figures.degenerate);
}

int show_info(const std::string& path, const strands::ReadOptions& options, bool json) {
  const auto file = read_groom_file(path, options);
  if (!file) return report(file.error());
  const strands::GroomStatistics figures = strands::statistics(file->groom);
  if (json)
    fmt::print("{}\n", to_json(path, *file, figures).dump(2));
  else
    print_text(*file, figures);
  return Exit::ok;
}

}  // namespace

void add_info(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand(
      "info",
      "describe a groom or character file: strands, lengths, spacing, units; joints, clips, weights; what is wrong");
  auto path = std::make_shared<std::string>();
  auto options = std::make_shared<strands::ReadOptions>();
  command->add_option("file", *path, groom_help(false) + "; character: .glb or .gltf")->required();
  command->add_option("--metres-per-unit", options->metres_per_unit, "scale of the file; 0 = guess");
  command->add_option("--radius", options->radius, "fibre radius in metres; 0 = the file's own");
  command->add_flag("--repair", options->repair, "mend what is damaged instead of refusing it, and count it");
  auto character = std::make_shared<CharacterInfoRequest>();
  command->add_option("--convention", character->convention,
                      "JSON: a character's metres_per_unit, up, forward, bones by hand");
  command->add_option("--skeleton", character->skeleton, "BVH whose bones are mapped onto the character's");
  command->callback([&context, path, options, character] {
    context.action = [&context, path, options, character] {
      if (!is_character_file(*path)) return show_info(*path, *options, context.json);
      character->file = *path;
      character->metres_per_unit = options->metres_per_unit;
      return show_character(*character, context.json);
    };
  });
}

}  // namespace cuticle::cli
