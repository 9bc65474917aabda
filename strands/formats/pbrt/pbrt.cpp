// Curve shapes of pbrt-v3 and pbrt-v4 (file formats at https://pbrt.org): cubic Bezier curves through the points,
// Catmull-Rom between.
#include <cmath>
#include <iterator>
#include <limits>

#include <fmt/core.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "strands/formats/bytes.h"
#include "strands/formats/curve_basis.h"
#include "strands/formats/tokens.h"
#include "strands/formats/words.h"

namespace cuticle::strands::pbrt {

namespace {

/// The parameters of one `Shape "curve"` with pbrt's defaults.
struct Curve {
  std::vector<float> numbers;  ///< of P
  CurveBasis basis{CurveBasis::Kind::bezier};
  double width[2] = {1, 1};
};

class Reader {
 public:
  Reader(std::string_view text, const std::string& where, Damage damage)
      : tokens_(text), where_(where), damage_(damage) {}

  Result<ParsedGroom> read() {
    token_ = tokens_.next();
    while (token_.kind != Token::Kind::end) CUTICLE_TRY(read_statement());
    if (parsed_.groom.strand_count() == 0)
      return line_error(where_, tokens_.line(), "no Shape \"curve\", at least 1 is needed");
    if (is_transformed_) parsed_.notes.push_back("the file's transformations are not applied");
    if (has_include_) parsed_.notes.push_back("the file's Include and Import are not followed");
    if (bend_ > 0)
      parsed_.notes.push_back(
          fmt::format("curves bend by up to {:.3g} units between their joints, which alone are kept", bend_));
    return std::move(parsed_);
  }

 private:
  Result<void> read_statement() {
    const std::string_view word = token_.kind == Token::Kind::word ? token_.text : "";
    token_ = tokens_.next();
    if (word == "Shape" && token_.kind == Token::Kind::string && token_.text == "curve") {
      token_ = tokens_.next();
      return read_curve();
    }
    if (word.empty()) return {};
    continues_ = false;
    if (word == "WorldBegin") is_transformed_ = false;
    if (word == "Transform" || word == "ConcatTransform" || word == "Translate" || word == "Rotate" || word == "Scale")
      is_transformed_ = true;
    if (word == "Include" || word == "Import") has_include_ = true;
    return {};
  }

  Result<void> read_curve() {
    Curve curve;
    while (token_.kind == Token::Kind::string) CUTICLE_TRY(read_parameter(curve));
    return add(curve);
  }

  /// `"type name" value` or `"type name" [ values ]`.
  Result<void> read_parameter(Curve& curve) {
    const std::string_view declaration = token_.text;
    const std::string_view name = declaration.substr(declaration.find_last_of(" \t") + 1);
    token_ = tokens_.next();
    const bool has_brackets = token_.is('[');
    if (has_brackets) token_ = tokens_.next();
    while (!token_.is(']') && token_.kind != Token::Kind::end) {
      CUTICLE_TRY(read_value(name, curve));
      token_ = tokens_.next();
      if (!has_brackets) return {};
    }
    token_ = tokens_.next();
    return {};
  }

  Result<void> read_value(std::string_view name, Curve& curve) {
    if (name == "basis") {
      curve.basis.kind = token_.text == "bspline" ? CurveBasis::Kind::b_spline : CurveBasis::Kind::bezier;
      return {};
    }
    const bool is_degree = name == "degree";
    if (name != "P" && !is_degree && name != "width" && name != "width0" && name != "width1") return {};
    const std::optional<double> value = token_.kind == Token::Kind::word ? to_number(token_.text) : std::nullopt;
    if (!value || (damage_ == Damage::refuse && !std::isfinite(float(*value))))
      return line_error(where_, tokens_.line(),
                        fmt::format("{} '{}', must be a finite number", name, token_.text.substr(0, 40)));
    if (is_degree && *value != 2 && *value != 3)
      return line_error(where_, tokens_.line(), fmt::format("degree {}, allowed 2 or 3", *value));
    if (name == "P") curve.numbers.push_back(float(*value));
    if (is_degree) curve.basis.degree = std::size_t(*value);
    if (name == "width" || name == "width0") curve.width[0] = *value;
    if (name == "width" || name == "width1") curve.width[1] = *value;
    return {};
  }

  Result<void> add(const Curve& curve) {
    const std::span points(reinterpret_cast<const glm::vec3*>(curve.numbers.data()), curve.numbers.size() / 3);
    if (curve.numbers.size() % 3 != 0 || !makes_a_curve(curve.basis, points.size()))
      return line_error(
          where_, tokens_.line(),
          fmt::format("P has {} numbers: no curve of degree {}", curve.numbers.size(), curve.basis.degree));
    if ((curve.width[0] < 0 || curve.width[1] < 0) && damage_ == Damage::refuse)
      return line_error(where_, tokens_.line(),
                        fmt::format("widths {} and {}, must be at least 0", curve.width[0], curve.width[1]));
    Groom& groom = parsed_.groom;
    const std::vector<glm::vec3> polyline = joints(curve.basis, points);
    const bool is_piece = curve.basis.kind == CurveBasis::Kind::bezier && polyline.size() == 2;
    const bool goes_on = continues_ && is_piece && groom.positions.back() == polyline.front();
    for (std::size_t i = goes_on ? 1 : 0; i < polyline.size(); ++i) {
      groom.positions.push_back(polyline[i]);
      groom.radii.push_back(0.5f *
                            float(std::lerp(curve.width[0], curve.width[1], double(i) / double(polyline.size() - 1))));
    }
    if (goes_on) groom.offsets.pop_back();
    groom.offsets.push_back(std::uint32_t(groom.vertex_count()));
    continues_ = is_piece;
    measure_bend(curve.basis, points);
    return {};
  }

  /// How far the middle of each cubic lies from that of its chord.
  void measure_bend(const CurveBasis& basis, std::span<const glm::vec3> p) {
    if (basis.kind != CurveBasis::Kind::bezier || basis.degree != 3) return;
    for (std::size_t i = 0; i + 3 < p.size(); i += 3) {
      const float bend = glm::length((p[i + 1] + p[i + 2] - p[i] - p[i + 3]) * 0.375f);
      if (bend > bend_) bend_ = bend;
    }
  }

  Tokens tokens_;
  Token token_;
  const std::string& where_;
  Damage damage_;
  ParsedGroom parsed_;
  bool continues_ = false;  ///< the statement before was a curve of one piece, which the next may go on from
  bool is_transformed_ = false, has_include_ = false;
  float bend_ = 0;
};

Result<ParsedGroom> parse(std::span<const std::byte> bytes, const std::string& where, Damage damage) {
  return Reader(to_text(bytes), where, damage).read();
}

void append_point(std::string& text, const glm::dvec3& point) {
  const double most = double(std::numeric_limits<float>::max());
  const glm::vec3 p(glm::clamp(point, -most, most));
  fmt::format_to(std::back_inserter(text), "{} {} {} ", p.x, p.y, p.z);
}

/// A third of the tangent at vertex i: of the Catmull-Rom curve, one-sided at the ends.
glm::dvec3 third_of_tangent(std::span<const glm::vec3> points, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, points.size() - 1);
  return (glm::dvec3(points[after]) - glm::dvec3(points[before])) / (3.0 * double(after - before));
}

void append_curve(std::string& text, std::span<const glm::vec3> points, float root_radius, float tip_radius) {
  text += "Shape \"curve\" \"string type\" \"cylinder\" \"point3 P\" [ ";
  append_point(text, points[0]);
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    append_point(text, glm::dvec3(points[i]) + third_of_tangent(points, i));
    append_point(text, glm::dvec3(points[i + 1]) - third_of_tangent(points, i + 1));
    append_point(text, points[i + 1]);
  }
  fmt::format_to(std::back_inserter(text), "] \"float width0\" {} \"float width1\" {}\n", 2 * root_radius,
                 2 * tip_radius);
}

Result<std::vector<std::byte>> format_pbrt(const Groom& groom, double) {
  std::string text = "# Hair: cubic Bezier curves through the points of the strands.\n";
  for (std::size_t s = 0; s < groom.strand_count(); ++s) {
    const std::span<const glm::vec3> points = groom.strand(s);
    // A curve that begins where the one before ends reads as a piece of it, unless a statement lies between.
    const bool apart = s > 0 && groom.positions[groom.offsets[s] - 1] == points.front();
    if (apart) text += "AttributeBegin\nAttributeEnd\n";
    append_curve(text, points, groom.radii[groom.offsets[s]], groom.radii[groom.offsets[s + 1] - 1]);
  }
  return to_bytes(text);
}

constexpr std::string_view k_extensions[] = {"pbrt"};

}  // namespace

const Format& entry() {
  static const Format format{.name = "pbrt",
                             .extensions = k_extensions,
                             .summary = "curve shapes of pbrt",
                             .holds = {.widths = Widths::ends},
                             .parse = parse,
                             .format = format_pbrt};
  return format;
}

}  // namespace cuticle::strands::pbrt
