#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cuticle/cli/character_info.h>
#include <cuticle/strands/formats/formats.h>
#include <cuticle/strands/statistics.h>

namespace cuticle::cli {

namespace {

using nlohmann::ordered_json;
using strands::Spread;

ordered_json to_json(const Spread& spread) {
  return {{"min", spread.least}, {"median", spread.median}, {"mean", spread.mean}, {"max", spread.greatest}};
}
ordered_json to_json(const glm::vec3& v) { return {v.x, v.y, v.z}; }

ordered_json to_json(const std::vector<strands::DegenerateStrand>& degenerate) {
  ordered_json list = ordered_json::array();
  for (const auto& strand : degenerate)
    list.push_back({{"strand", strand.strand},
                    {"coincident_segments", strand.coincident_segments},
                    {"has_length", strand.has_length}});
  return list;
}

ordered_json to_json(const std::string& path, const strands::GroomFile& file, const strands::GroomStatistics& figures) {
  ordered_json attributes = ordered_json::array();
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
  fmt::print("{:<22}{} metres per unit\n", "units", file.metres_per_unit);
  for (const std::string& note : file.notes) fmt::print("{:<22}{}\n", "note", note);
  print_degenerate(figures.degenerate);
}

int show_info(const std::string& path, const strands::ReadOptions& options, bool json) {
  const auto file = strands::read_groom(path, options);
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
  auto* command =
      app.add_subcommand("info", "what a groom or character file holds: strands, lengths, spacing, units; joints, clips, weights; what is amiss");
  auto path = std::make_shared<std::string>();
  auto options = std::make_shared<strands::ReadOptions>();
  command->add_option("file", *path, "groom: .hair or .tfx; character: .glb or .gltf")->required();
  command->add_option("--metres-per-unit", options->metres_per_unit, "scale of the file; 0 = guess");
  command->add_option("--radius", options->radius, "fibre radius in metres; 0 = the file's own");
  auto character = std::make_shared<CharacterInfoRequest>();
  command->add_option("--convention", character->convention, "JSON: a character's metres_per_unit, up, forward, bones by hand");
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
