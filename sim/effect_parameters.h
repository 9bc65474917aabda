#pragma once
// Rows of the parameter tables of solvers and effects: by type, and those that several solvers have.
#include "core/registry/entry.h"

namespace cuticle::sim {

constexpr registry::Parameter real_parameter(std::string_view name, std::string_view unit, double minimum,
                                             double maximum, std::string_view default_text, std::string_view summary) {
  return {.name = name,
          .type = registry::ParameterType::real,
          .unit = unit,
          .minimum = minimum,
          .maximum = maximum,
          .default_text = default_text,
          .summary = summary};
}
constexpr registry::Parameter whole_parameter(std::string_view name, double minimum, double maximum,
                                              std::string_view default_text, std::string_view summary) {
  return {.name = name,
          .type = registry::ParameterType::integer,
          .minimum = minimum,
          .maximum = maximum,
          .default_text = default_text,
          .summary = summary};
}
constexpr registry::Parameter flag_parameter(std::string_view name, std::string_view default_text,
                                             std::string_view summary) {
  return {.name = name, .type = registry::ParameterType::boolean, .default_text = default_text, .summary = summary};
}

constexpr registry::Parameter vector_parameter(std::string_view name, std::string_view unit, double minimum,
                                               double maximum, std::string_view default_text,
                                               std::string_view summary) {
  return {.name = name,
          .type = registry::ParameterType::rgb,
          .unit = unit,
          .minimum = minimum,
          .maximum = maximum,
          .default_text = default_text,
          .summary = summary};
}

constexpr registry::Parameter inner_step(double maximum, std::string_view default_text) {
  return real_parameter("inner_step", "s", 1e-5, maximum, default_text,
                        "longest substep; a frame is cut into equal parts of at most this");
}
constexpr registry::Parameter k_max_substeps =
    whole_parameter("max_substeps", 1, 4096, "64", "most substeps in a frame; past that the substep stretches");
constexpr registry::Parameter k_damping =
    real_parameter("damping", "1/s", 0, 1000, "2", "drag of still air: velocity decays as exp(-damping t)");
constexpr registry::Parameter k_shape_stiffness =
    real_parameter("shape_stiffness", "1/s", 0, 1000, "12",
                   "rate of the critically damped pull towards the rest pose carried by the head, at the root");
constexpr registry::Parameter k_shape_tip =
    real_parameter("shape_tip", "1", 0, 1, "0.5", "share of the shape stiffness left at the tip");
constexpr registry::Parameter k_sag_free =
    flag_parameter("sag_free", "true",
                   "the groom is combed under gravity: the pull, if there is one, carries the weight of the rest pose");
constexpr registry::Parameter clamped_vertices(std::string_view default_text, std::string_view summary) {
  return whole_parameter("clamped_vertices", 1, 2, default_text, summary);
}
constexpr registry::Parameter k_clamped_vertices = clamped_vertices(
    "2", "first vertices of a strand that the head carries: 2 keeps the direction in which hair leaves the scalp");

constexpr std::string_view k_solver_demands[] = {"simulation"};

}  // namespace cuticle::sim
