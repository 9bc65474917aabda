#include "strands/formats/vtp/vtp.h"

#include <iterator>

#include <fmt/core.h>

#include "strands/formats/vtp/detail/arrays.h"

namespace cuticle::strands {

namespace {

/// The strand of every vertex.
std::vector<std::uint32_t> strand_ids(const Groom& groom) {
  std::vector<std::uint32_t> ids;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) ids.insert(ids.end(), groom.strand_size(s), std::uint32_t(s));
  return ids;
}

/// Of the strands that are lines.
void append_guards(std::string& text, const Groom& groom, std::span<const std::uint32_t> fired) {
  CUTICLE_EXPECT(fired.size() == groom.strand_count(), "one entry per strand");
  std::vector<std::uint32_t> of_lines;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    if (groom.strand_size(s) >= 2) of_lines.push_back(fired[s]);
  text += "<CellData>\n";
  append_array(text, "UInt32", "guard_fired", of_lines);
  text += "</CellData>\n";
}

}  // namespace

std::string format_vtp(const StrandState& state) {
  const Groom& groom = *state.groom;
  const std::size_t points = groom.offsets.back();
  CUTICLE_EXPECT(state.positions.size() == points && state.velocities.size() == points &&
                     state.stretch.size() == points && (state.tension.empty() || state.tension.size() == points) &&
                     (state.curvature.empty() || state.curvature.size() == points) &&
                     (state.contact.empty() || state.contact.size() == points),
                 "one entry per vertex");
  std::string text = open_piece(points, line_count(groom));
  text += "<PointData Scalars=\"stretch\" Vectors=\"velocity\">\n";
  append_array(text, "velocity", state.velocities);
  append_array(text, "stretch", 1, state.stretch);
  if (!state.tension.empty()) append_array(text, "tension", 1, state.tension);
  if (!state.curvature.empty()) append_array(text, "curvature", 1, state.curvature);
  if (!state.contact.empty()) append_array(text, "contact", 1, state.contact);
  append_array(text, "UInt32", "strand_id", strand_ids(groom));
  text += "</PointData>\n";
  if (!state.guard_fired.empty()) append_guards(text, groom, state.guard_fired);
  text += "<Points>\n";
  append_array(text, "position", state.positions);
  text += "</Points>\n<Lines>\n";
  append_lines(text, groom);
  text += "</Lines>\n";
  return text += close_piece();
}

std::size_t vtp_bytes_at_most(const Groom& groom) {
  constexpr std::size_t number = 16, index = 11, frame = 4096;  // -1.23456789e-05 and 4294967295, with what parts them
  return frame + groom.offsets.back() * (10 * number + 2 * index) + groom.strand_count() * 2 * index;
}

std::string format_pvd(std::span<const SeriesMember> members) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const SeriesMember& member : members)
    fmt::format_to(std::back_inserter(text), "<DataSet timestep=\"{:.9g}\" part=\"0\" file=\"{}\"/>\n", member.time,
                   member.file);
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace cuticle::strands
