#include "bsdf/materialx/materialx.h"

#include <cmath>
#include <numbers>
#include <sstream>
#include <vector>

#include <fmt/core.h>

#include "bsdf/chiang/chiang.h"
#include "bsdf/chiang/conversions.h"
#include "bsdf/materialx/document.h"
#include "core/file.h"

namespace cuticle::bsdf {
namespace {

using materialx::HairNode;
using materialx::Numbers;

constexpr std::size_t largest_file = 16u << 20;
using std::numbers::pi;

/// The one chiang_hair_bsdf of the document.
Result<HairNode> find_hair(const pugi::xml_document& document, std::string_view file) {
  std::vector<pugi::xml_node> found;
  for (const pugi::xpath_node& match : document.select_nodes("//chiang_hair_bsdf")) found.push_back(match.node());
  if (found.size() != 1) return bad_input(fmt::format("{}: {} nodes chiang_hair_bsdf, not 1", file, found.size()));
  return HairNode::make(found[0], file);
}

/// Words for inputs that the model cannot express.
Result<std::string> left_out(const HairNode& hair, const Numbers& r) {
  std::string words;
  for (const char* name : {"tint_R", "tint_TT", "tint_TRT"}) {
    CUTICLE_ASSIGN(const Numbers tint, hair.value(name));
    if (tint != Numbers{1, 1, 1}) words += fmt::format("; {} is left out: the model has no tints", name);
  }
  for (const auto& [name, factor] : {std::pair{"roughness_TT", 0.25}, std::pair{"roughness_TRT", 4.0}}) {
    CUTICLE_ASSIGN(const Numbers lobe, hair.value(name));
    if (std::abs(lobe[0] - factor * r[0]) > 1e-5 * lobe[0] || std::abs(lobe[1] - r[1]) > 1e-5 * lobe[1])
      words +=
          fmt::format("; {} = {:g}, {:g} is left out: the model's follows from roughness_R", name, lobe[0], lobe[1]);
  }
  return words;
}

Result<FibreMapping> mapped(const HairNode& hair) {
  CUTICLE_ASSIGN(const Numbers ior, hair.value("ior"));
  CUTICLE_ASSIGN(const Numbers roughness, hair.value("roughness_R"));
  CUTICLE_ASSIGN(const Numbers angle, hair.value("cuticle_angle"));
  CUTICLE_ASSIGN(const Numbers sigma_a, hair.value("absorption_coefficient"));
  CUTICLE_ASSIGN(const std::string words, left_out(hair, roughness));
  const double beta_m = chiang::beta_m_from_deviation(std::sqrt(roughness[0]));
  const double beta_n = chiang::beta_n_from_scale(roughness[1] * std::sqrt(pi / 8));
  constexpr double most_tilt = 0.17453292519943295;
  const double alpha = std::clamp((angle[0] - 0.5) * pi, -most_tilt, most_tilt);
  return FibreMapping{
      fmt::format("eta={},sigma_a={}/{}/{},beta_m={},beta_n={},alpha={}", ior[0], sigma_a[0], sigma_a[1], sigma_a[2],
                  beta_m, beta_n, alpha),
      "eta is ior, sigma_a absorption_coefficient per radius, beta_m and beta_n those whose variance and "
      "scale are roughness_R, alpha pi (cuticle_angle - 0.5) with u along curve_direction" +
          words};
}

void add_input(pugi::xml_node node, const char* name, const char* type, const std::string& value) {
  pugi::xml_node input = node.append_child("input");
  input.append_attribute("name") = name;
  input.append_attribute("type") = type;
  input.append_attribute("value") = value.c_str();
}

void add_connection(pugi::xml_node node, const char* name, const char* type, const char* target, const char* output) {
  pugi::xml_node input = node.append_child("input");
  input.append_attribute("name") = name;
  input.append_attribute("type") = type;
  input.append_attribute("nodename") = target;
  if (*output) input.append_attribute("output") = output;
}

pugi::xml_node add_node(pugi::xml_node parent, const char* category, const char* name, const char* type) {
  pugi::xml_node node = parent.append_child(category);
  node.append_attribute("name") = name;
  node.append_attribute("type") = type;
  return node;
}

void add_hair(pugi::xml_node root, const chiang::Parameters& p) {
  pugi::xml_node roughness = add_node(root, "chiang_hair_roughness", "roughness", "multioutput");
  add_input(roughness, "longitudinal", "float", fmt::format("{}", p.beta_m));
  add_input(roughness, "azimuthal", "float", fmt::format("{}", p.beta_n));
  pugi::xml_node hair = add_node(root, "chiang_hair_bsdf", "hair", "BSDF");
  add_input(hair, "ior", "float", fmt::format("{}", p.eta));
  add_input(hair, "cuticle_angle", "float", fmt::format("{}", 0.5 + p.alpha / pi));
  add_input(hair, "absorption_coefficient", "vector3",
            fmt::format("{}, {}, {}", p.sigma_a.x, p.sigma_a.y, p.sigma_a.z));
  for (const char* output : {"roughness_R", "roughness_TT", "roughness_TRT"})
    add_connection(hair, output, "vector2", "roughness", output);
}

}  // namespace

Result<FibreMapping> parse_materialx(std::string_view xml, std::string_view file) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(xml.data(), xml.size());
  if (!parsed) return bad_input(fmt::format("{}: at byte {}: {}", file, parsed.offset, parsed.description()));
  if (!document.child("materialx")) return bad_input(fmt::format("{}: no element <materialx> at the top", file));
  CUTICLE_ASSIGN(const HairNode hair, find_hair(document, file));
  return mapped(hair);
}

Result<FibreMapping> read_materialx(const std::string& path) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  if (text.size() > largest_file)
    return bad_input(fmt::format("{}: {} bytes; at most {} are read", path, text.size(), largest_file));
  return parse_materialx(text, path);
}

std::string write_materialx(const registry::ParameterValues& values) {
  pugi::xml_document document;
  pugi::xml_node root = document.append_child("materialx");
  root.append_attribute("version") = "1.39";
  add_hair(root, registry::from_values<chiang::Parameters>(values));
  add_connection(add_node(root, "surface", "surface", "surfaceshader"), "bsdf", "BSDF", "hair", "");
  add_connection(add_node(root, "surfacematerial", "material", "material"), "surfaceshader", "surfaceshader", "surface",
                 "");
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace cuticle::bsdf
