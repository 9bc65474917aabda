#pragma once
// The hair nodes of MaterialX 1.39 with their inputs, as pbrlib_defs.mtlx has them.
#include <array>
#include <limits>
#include <span>
#include <string_view>

namespace cuticle::bsdf::materialx {

/// Up to three numbers: float 1, vector2 2, color3 and vector3 3.
using Numbers = std::array<double, 3>;

/// An input: the inclusive range that its numbers may have, and their default.
struct InputSpec {
  std::string_view name, type;
  double minimum, maximum;
  Numbers fallback;
};

/// A node by its category; `outputs` with one type for all.
struct NodeSpec {
  std::string_view category;
  std::span<const InputSpec> inputs;
  std::span<const std::string_view> outputs;
  std::string_view output_type;
};

constexpr double any = std::numeric_limits<double>::max();

inline constexpr std::array<InputSpec, 11> hair_inputs = {{
    {"tint_R", "color3", 0, any, {1, 1, 1}},
    {"tint_TT", "color3", 0, any, {1, 1, 1}},
    {"tint_TRT", "color3", 0, any, {1, 1, 1}},
    {"ior", "float", 1.05, 3, {1.55}},
    {"roughness_R", "vector2", 0, any, {0.1, 0.1}},
    {"roughness_TT", "vector2", 0, any, {0.05, 0.05}},
    {"roughness_TRT", "vector2", 0, any, {0.2, 0.2}},
    // 0 .. 1 stands for a tilt of -90 .. 90 degrees; the model has -10 .. 10.
    {"cuticle_angle", "float", 0.5 - 10.0 / 180, 0.5 + 10.0 / 180, {0.5}},
    {"absorption_coefficient", "vector3", 0, 100, {0, 0, 0}},
    {"normal", "vector3", -any, any, {0, 0, 1}},
    {"curve_direction", "vector3", -any, any, {1, 0, 0}},
}};
inline constexpr std::array<InputSpec, 4> roughness_inputs = {{
    {"longitudinal", "float", 0, 1, {0.1}},
    {"azimuthal", "float", 0, 1, {0.2}},
    {"scale_TT", "float", 0, any, {0.5}},
    {"scale_TRT", "float", 0, any, {2}},
}};
inline constexpr std::array<InputSpec, 2> color_inputs = {{
    {"color", "color3", 0, 1, {1, 1, 1}},
    {"azimuthal_roughness", "float", 0, 1, {0.2}},
}};
inline constexpr std::array<InputSpec, 4> melanin_inputs = {{
    {"melanin_concentration", "float", 0, 1, {0.25}},
    {"melanin_redness", "float", 0, 1, {0.5}},
    {"eumelanin_color", "color3", 1e-6, 1, {0.657704, 0.498077, 0.254107}},
    {"pheomelanin_color", "color3", 1e-6, 1, {0.829444, 0.67032, 0.349938}},
}};

inline constexpr std::array<std::string_view, 1> bsdf_output = {"out"};
inline constexpr std::array<std::string_view, 1> absorption_output = {"absorption"};
inline constexpr std::array<std::string_view, 3> roughness_outputs = {"roughness_R", "roughness_TT", "roughness_TRT"};

inline constexpr std::array<NodeSpec, 4> node_specs = {{
    {"chiang_hair_bsdf", hair_inputs, bsdf_output, "BSDF"},
    {"chiang_hair_roughness", roughness_inputs, roughness_outputs, "vector2"},
    {"chiang_hair_absorption_from_color", color_inputs, absorption_output, "vector3"},
    {"deon_hair_absorption_from_melanin", melanin_inputs, absorption_output, "vector3"},
}};

/// How many numbers a type has; 0 for any other type.
constexpr int numbers_of(std::string_view type) {
  if (type == "float") return 1;
  if (type == "vector2") return 2;
  return type == "color3" || type == "vector3" ? 3 : 0;
}

}  // namespace cuticle::bsdf::materialx
