// Grooms as VTK XML PolyData (.vtp): a polyline a strand, arrays of points and of cells. Written as text.
#include <cmath>

#include <fmt/core.h>

#include "strands/formats/bytes.h"
#include "strands/formats/vtp/detail/arrays.h"
#include "strands/formats/vtp/detail/values.h"

namespace cuticle::strands::vtp {

namespace {

using pugi::xml_node;

/// Reads one piece of a file; messages name the file and the array.
class PieceReader {
 public:
  PieceReader(const VtkFile& file, xml_node piece, Damage damage) : file_(file), piece_(piece), damage_(damage) {}

  Result<Groom> read() {
    CUTICLE_ASSIGN(points_, numbers(piece_.child("Points").child("DataArray")));
    if (points_.size() % 3 != 0)
      return error("Points", fmt::format("{} numbers, 3 a point are needed", points_.size()));
    CUTICLE_TRY(read_lines());
    if (vertices_.empty()) return error("connectivity", "no points, at least 1 is needed");
    gather(points_, 3, vertices_, &groom_.positions);
    CUTICLE_TRY(require_finite_values("Points", {&groom_.positions.front().x, 3 * vertices_.size()}));
    groom_.radii.assign(vertices_.size(), 0.0f);
    for (xml_node array : piece_.child("PointData").children("DataArray")) CUTICLE_TRY(read_point_array(array));
    for (xml_node array : piece_.child("CellData").children("DataArray")) CUTICLE_TRY(read_cell_array(array));
    return std::move(groom_);
  }

 private:
  Error error(const std::string& array, const std::string& problem) const { return file_.error(array, problem); }
  Result<std::vector<double>> numbers(xml_node array) const { return file_.numbers(array); }

  xml_node line_array(const char* name) const {
    return piece_.child("Lines").find_child_by_attribute("DataArray", "Name", name);
  }

  Result<void> read_lines() {
    CUTICLE_ASSIGN(const std::vector<double> connectivity, numbers(line_array("connectivity")));
    CUTICLE_ASSIGN(const std::vector<double> ends, numbers(line_array("offsets")));
    const double points = double(points_.size() / 3), least = damage_ == Damage::keep ? 0 : 2;
    for (double vertex : connectivity) {
      if (!(vertex >= 0 && vertex < points) || vertex != std::floor(vertex))
        return error("connectivity", fmt::format("{}, allowed 0 .. {}", vertex, points - 1));
      vertices_.push_back(std::uint32_t(vertex));
    }
    for (double end : ends) {
      const double begin = groom_.offsets.back();
      if (!(end >= begin + least && end <= double(vertices_.size())) || end != std::floor(end))
        return error("offsets", fmt::format("line {} ends at {}, allowed {} .. {}", groom_.strand_count(), end,
                                            begin + least, vertices_.size()));
      groom_.offsets.push_back(std::uint32_t(end));
    }
    if (groom_.strand_count() == 0 || groom_.offsets.back() != vertices_.size())
      return error("offsets", fmt::format("{} lines end at {} of {}", groom_.strand_count(), groom_.offsets.back(),
                                          vertices_.size()));
    return {};
  }

  /// Items of the rows that are named, into floats or vectors of them.
  template <class T>
  static void gather(const std::vector<double>& values, std::size_t components, std::span<const std::uint32_t> rows,
                     std::vector<T>* out) {
    out->resize(rows.size() * components * sizeof(float) / sizeof(T));
    float* at = reinterpret_cast<float*>(out->data());
    for (std::uint32_t row : rows)
      for (std::size_t c = 0; c < components; ++c) *at++ = float(values[row * components + c]);
  }

  /// The array's components; 0 where it is no array of `rows` rows.
  static std::size_t components_of(const std::vector<double>& values, std::size_t rows) {
    return values.empty() || values.size() % rows != 0 ? 0 : values.size() / rows;
  }

  Result<void> read_point_array(xml_node array) {
    const std::string name = array.attribute("Name").as_string();
    if (name == "strand_id") return {};
    CUTICLE_ASSIGN(const std::vector<double> values, numbers(array));
    const std::size_t components = components_of(values, points_.size() / 3);
    if (components == 0) return error(name, fmt::format("{} numbers for {} points", values.size(), points_.size() / 3));
    if (name == "radius" && components == 1) {
      gather(values, 1, vertices_, &groom_.radii);
      return require_radii();
    }
    Attribute& attribute = groom_.attributes[name] = {Attribute::Domain::vertex, int(components), {}};
    gather(values, components, vertices_, &attribute.values);
    return require_finite_values(name, attribute.values);
  }

  Result<void> require_radii() const {
    for (std::size_t v = 0; v < groom_.radii.size(); ++v)
      if (damage_ == Damage::refuse && !(groom_.radii[v] >= 0 && std::isfinite(groom_.radii[v])))
        return error("radius",
                     fmt::format("{} at vertex {}, must be finite and at least 0", double(groom_.radii[v]), v));
    return {};
  }

  Result<void> require_finite_values(const std::string& name, std::span<const float> values) const {
    for (std::size_t i = 0; damage_ == Damage::refuse && i < values.size(); ++i)
      if (!std::isfinite(values[i])) return error(name, fmt::format("value {} is not finite", i));
    return {};
  }

  /// Cells are ordered: single vertices, lines, polygons, strips.
  Result<void> read_cell_array(xml_node array) {
    const std::string name = array.attribute("Name").as_string();
    CUTICLE_ASSIGN(const std::vector<double> values, numbers(array));
    std::size_t cells = 0;
    for (const char* kind : {"NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys"})
      cells += piece_.attribute(kind).as_uint();
    const std::size_t first = piece_.attribute("NumberOfVerts").as_uint(), strands = groom_.strand_count();
    const std::size_t components = cells < first + strands ? 0 : components_of(values, cells);
    if (components == 0) return error(name, fmt::format("{} numbers for {} cells", values.size(), cells));
    std::vector<std::uint32_t> rows(strands);
    for (std::size_t s = 0; s < strands; ++s) rows[s] = std::uint32_t(first + s);
    if (name == "root_uv" && components == 2)
      gather(values, 2, rows, &groom_.root_uv);
    else if (name == "root_barycentrics" && components == 2)
      gather(values, 2, rows, &groom_.root_barycentrics);
    else if (name == "root_triangle" && components == 1)
      return read_triangles(values, first);
    else {
      Attribute& attribute = groom_.attributes[name] = {Attribute::Domain::strand, int(components), {}};
      gather(values, components, rows, &attribute.values);
      return require_finite_values(name, attribute.values);
    }
    return {};
  }

  Result<void> read_triangles(const std::vector<double>& values, std::size_t first) {
    for (std::size_t s = 0; s < groom_.strand_count(); ++s) {
      const double triangle = values[first + s];
      if (!(triangle >= 0 && triangle <= 4294967295.0))
        return error("root_triangle", fmt::format("{} of strand {}", triangle, s));
      groom_.root_triangle.push_back(std::uint32_t(triangle));
    }
    return {};
  }

  const VtkFile& file_;
  xml_node piece_;
  Damage damage_;
  Groom groom_;
  std::vector<double> points_;
  std::vector<std::uint32_t> vertices_;  ///< of the lines, one after the other
};

Result<ParsedGroom> parse(std::span<const std::byte> bytes, const std::string& where, Damage damage) {
  VtkFile file;
  CUTICLE_TRY(file.open(bytes, where));
  ParsedGroom parsed;
  for (xml_node piece : file.root().child("PolyData").children("Piece")) {
    if (piece.attribute("NumberOfLines").as_uint() == 0) continue;
    CUTICLE_ASSIGN(Groom groom, PieceReader(file, piece, damage).read());
    if (parsed.groom.strand_count() == 0)
      parsed.groom = std::move(groom);
    else
      append(parsed.groom, groom);
  }
  if (parsed.groom.strand_count() == 0)
    return bad_input(fmt::format("{}: PolyData: no lines, at least 1 is needed", where));
  return parsed;
}

void append_attributes(std::string& text, const Groom& groom, Attribute::Domain domain) {
  for (const auto& [name, attribute] : groom.attributes)
    if (attribute.domain == domain) append_array(text, name, attribute.components, attribute.values);
}

void append_pairs(std::string& text, std::string_view name, const std::vector<glm::vec2>& pairs) {
  if (!pairs.empty()) append_array(text, name, 2, {&pairs.front().x, 2 * pairs.size()});
}

Result<std::vector<std::byte>> format_groom(const Groom& groom, double) {
  constexpr std::size_t k_bytes_of_vertex = 56;  // so that the text is seldom moved
  std::string text;
  text.reserve(groom.vertex_count() * k_bytes_of_vertex);
  text += open_piece(groom.vertex_count(), groom.strand_count()) + "<PointData Scalars=\"radius\">\n";
  append_array(text, "radius", 1, groom.radii);
  append_attributes(text, groom, Attribute::Domain::vertex);
  text += "</PointData>\n<CellData>\n";
  append_pairs(text, "root_uv", groom.root_uv);
  append_pairs(text, "root_barycentrics", groom.root_barycentrics);
  if (!groom.root_triangle.empty()) append_array(text, "UInt32", "root_triangle", groom.root_triangle);
  append_attributes(text, groom, Attribute::Domain::strand);
  text += "</CellData>\n<Points>\n";
  append_array(text, "position", groom.positions);
  text += "</Points>\n<Lines>\n";
  append_lines(text, groom);
  text += "</Lines>\n";
  return to_bytes(text += close_piece());
}

constexpr std::string_view k_extensions[] = {"vtp"};

}  // namespace

const Format& entry() {
  static const Format format{.name = "vtp",
                             .extensions = k_extensions,
                             .summary = "VTK XML PolyData, for ParaView and PyVista; written as text",
                             .holds = {.widths = Widths::vertices, .root_uv = true, .roots = true, .attributes = true},
                             .parse = parse,
                             .format = format_groom};
  return format;
}

}  // namespace cuticle::strands::vtp
