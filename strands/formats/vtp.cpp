#include <cuticle/strands/formats/vtp.h>

#include <iterator>

#include <fmt/format.h>

namespace cuticle::strands {
namespace {

using Text = std::back_insert_iterator<std::string>;

void open_array(Text out, std::string_view type, std::string_view name, int components) {
  fmt::format_to(out, "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n", type, name, components);
}
void close_array(Text out) { fmt::format_to(out, "</DataArray>\n"); }

void write_vectors(Text out, std::string_view name, std::span<const glm::vec3> values) {
  open_array(out, "Float32", name, 3);
  for (const glm::vec3& v : values) fmt::format_to(out, "{:.9g} {:.9g} {:.9g}\n", v.x, v.y, v.z);
  close_array(out);
}

void write_scalars(Text out, std::string_view name, std::span<const float> values) {
  open_array(out, "Float32", name, 1);
  for (float value : values) fmt::format_to(out, "{:.9g}\n", value);
  close_array(out);
}

void write_strand_ids(Text out, const Groom& groom) {
  open_array(out, "UInt32", "strand_id", 1);
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::size_t i = 0; i < groom.strand_size(s); ++i) fmt::format_to(out, "{}\n", s);
  close_array(out);
}

std::size_t line_count(const Groom& groom) {
  std::size_t count = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s) count += groom.strand_size(s) > 1;
  return count;
}

void write_lines(Text out, const Groom& groom) {
  open_array(out, "Int64", "connectivity", 1);
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    for (std::uint32_t i = groom.offsets[s]; groom.strand_size(s) > 1 && i < groom.offsets[s + 1]; ++i) fmt::format_to(out, "{}\n", i);
  close_array(out);
  open_array(out, "Int64", "offsets", 1);
  std::size_t end = 0;
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    if (groom.strand_size(s) > 1) fmt::format_to(out, "{}\n", end += groom.strand_size(s));
  close_array(out);
}

}  // namespace

std::string format_vtp(const StrandState& state) {
  const Groom& groom = *state.groom;
  const std::size_t points = groom.offsets.back();
  CUTICLE_EXPECT(state.positions.size() == points && state.velocities.size() == points && state.stretch.size() == points,
                 "one entry per vertex");
  std::string text;
  const Text out(text);
  fmt::format_to(out, "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
                      "<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfLines=\"{}\">\n"
                      "<PointData Scalars=\"stretch\" Vectors=\"velocity\">\n", points, line_count(groom));
  write_vectors(out, "velocity", state.velocities);
  write_scalars(out, "stretch", state.stretch);
  write_strand_ids(out, groom);
  fmt::format_to(out, "</PointData>\n<Points>\n");
  write_vectors(out, "position", state.positions);
  fmt::format_to(out, "</Points>\n<Lines>\n");
  write_lines(out, groom);
  fmt::format_to(out, "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n");
  return text;
}

std::size_t vtp_bytes_at_most(const Groom& groom) {
  constexpr std::size_t number = 16, index = 11, frame = 2048;  // -1.23456789e-05 and 4294967295, with what parts them
  return frame + groom.offsets.back() * (7 * number + 2 * index) + groom.strand_count() * index;
}

std::string format_pvd(std::span<const SeriesMember> members) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const SeriesMember& member : members)
    fmt::format_to(Text(text), "<DataSet timestep=\"{:.9g}\" part=\"0\" file=\"{}\"/>\n", member.time, member.file);
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace cuticle::strands
