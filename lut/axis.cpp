#include <algorithm>
#include <cmath>
#include <numbers>

#include "lut/caustic.glslh"
#include "lut/evaluate.h"
#include "lut/half_vector.glslh"

namespace cuticle::lut {
namespace {

constexpr double k_pi = std::numbers::pi;

double itself(double x) { return x; }
double sine(double x) { return std::sin(x); }
double cosine(double x) { return std::cos(x); }
double arc_sine(double x) { return std::asin(x); }
double arc_cosine(double x) { return std::acos(x); }
/// An azimuth at about that place of the axis, where phi_c is in the middle: for weights.
double whole_turn(double x) { return std::copysign(x * x, x) * k_pi / 2; }
double turn_root(double x) { return std::copysign(std::sqrt(std::abs(x) * 2 / k_pi), x); }

/// In the order of AxisQuantity.
constexpr AxisInfo k_quantities[] = {
    {AxisQuantity::sin_theta_i, "sin_theta_i", "sin theta_i = dot(light direction, fibre tangent)",
     &bsdf::Point::theta_i, arc_sine, sine, -1, 1},
    {AxisQuantity::sin_theta_o, "sin_theta_o", "sin theta_o = dot(eye direction, fibre tangent)", &bsdf::Point::theta_o,
     arc_sine, sine, -1, 1},
    {AxisQuantity::cos_phi, "cos_phi",
     "cos phi = cosine between the two directions projected on the normal plane; N is even in phi", &bsdf::Point::phi,
     arc_cosine, cosine, -1, 1},
    {AxisQuantity::cos_theta_d, "cos_theta_d", "cos theta_d, theta_d = (theta_o - theta_i) / 2, from the table M",
     &bsdf::Point::theta_d, arc_cosine, cosine, 0, 1},
    {AxisQuantity::theta_i, "theta_i", "theta_i = asin(dot(light direction, fibre tangent)), radians",
     &bsdf::Point::theta_i, itself, itself, -k_pi / 2, k_pi / 2},
    {AxisQuantity::theta_o, "theta_o", "theta_o = asin(dot(eye direction, fibre tangent)), radians",
     &bsdf::Point::theta_o, itself, itself, -k_pi / 2, k_pi / 2},
    {AxisQuantity::phi, "phi",
     "phi = acos(cosine between the two directions projected on the normal plane), radians; N is even in phi",
     &bsdf::Point::phi, itself, itself, 0, k_pi},
    {AxisQuantity::theta_d, "theta_d", "abs(theta_d), theta_d = (theta_o - theta_i) / 2, radians; N is even in theta_d",
     &bsdf::Point::theta_d, itself, itself, 0, k_pi / 2},
    {AxisQuantity::from_caustic, "from_caustic",
     "side * (gap + (1 - gap) * root), with q = 3 cos^2 theta_d - (eta^2 - 1), phi_c = 2 atan(max(q, 0)^1.5 / "
     "(sqrt(eta^2 - 1) * (eta^2 - 1 + 9 cos^2 theta_d))); side -1 and root sqrt(1 - phi / phi_c) where phi < phi_c, "
     "else 1 and sqrt((phi - phi_c) / (pi - phi_c)); the table's values times 1 / max(side < 0 ? q * root : abs(q) + "
     "4 (phi - phi_c), 1e-5)",
     nullptr, whole_turn, turn_root, -1, 1},
    {AxisQuantity::abs_theta_o, "abs_theta_o",
     "abs(theta_o), theta_o = asin(dot(eye direction, fibre tangent)), radians", &bsdf::Point::theta_d, itself, itself,
     0, k_pi / 2},
    {AxisQuantity::theta_between, "theta_between", "acos(dot(light direction, eye direction)) / 2, radians", nullptr,
     itself, itself, 0, k_pi / 2},
    {AxisQuantity::theta_half, "theta_half",
     "asin(dot(half vector, fibre tangent)), half vector = normalize(light direction + eye direction), radians",
     nullptr, itself, itself, -k_pi / 2, k_pi / 2},
    {AxisQuantity::phi_half, "phi_half",
     "acos(cosine between the half vector and the eye direction, both projected on the normal plane), radians", nullptr,
     itself, itself, 0, k_pi},
    {AxisQuantity::cos_normal, "cos_normal", "cos theta_i * cos phi, with the signs of both", nullptr, itself, itself,
     -1, 1},
    {AxisQuantity::none, "none", "nothing: the table has one row", nullptr, itself, itself, 0, 1},
};

void set_quantity(bsdf::Point& point, AxisQuantity quantity, double value) {
  const AxisInfo& info = axis_info(quantity);
  if (info.angle) point.*info.angle = info.to_angle(std::clamp(value, info.lower, info.upper));
}

bool carries(const TableLayout& table, double bsdf::Point::*angle) {
  return axis_info(table.u.quantity).angle == angle || axis_info(table.v.quantity).angle == angle;
}

}  // namespace

const AxisInfo& axis_info(AxisQuantity quantity) { return k_quantities[std::size_t(quantity)]; }

glm::ivec2 table_size(const TableLayout& table, int size) {
  return {size, table.v.quantity == AxisQuantity::none ? 1 : size};
}

AxisMap axis_map(const Axis& axis, int size) {
  if (axis.quantity == AxisQuantity::none) return {0, 0.5};
  const double range = axis.upper - axis.lower;
  if (!axis.corner_aligned) return {1 / range, -axis.lower / range};
  const double scale = (size - 1) / (size * range);
  return {scale, 0.5 / size - axis.lower * scale};
}

double axis_value(const Axis& axis, int size, double coordinate) {
  if (axis.quantity == AxisQuantity::none) return 0;
  const AxisMap map = axis_map(axis, size);
  return std::clamp((coordinate - map.bias) / map.scale, axis.lower, axis.upper);
}

namespace {

bool is_from_caustic(const TableLayout& table) { return table.u.quantity == AxisQuantity::from_caustic; }

double cosine_squared(double angle) { return std::cos(angle) * std::cos(angle); }

/// Where a texel of an axis from the caustic lies.
void set_beside_caustic(bsdf::Point& point, double value, int size, double index) {
  const double found = cosine_squared(point.theta_d);
  const glm::dvec2 texel = caustic_texel(index * index - 1, 1.0 / (size - 1), value, found);
  point.phi = texel.x;
  if (texel.y != found) point.theta_d = std::acos(std::sqrt(texel.y));
}

FromCaustic<double> place_beside(const bsdf::Point& point, int size, double index) {
  return from_caustic(index * index - 1, 1.0 / (size - 1), std::abs(point.phi), cosine_squared(point.theta_d));
}

}  // namespace

bsdf::Point make_point(const TableLayout& table, double u_value, double v_value, int size, double caustic_index) {
  bsdf::Point point;
  set_quantity(point, table.u.quantity, u_value);
  set_quantity(point, table.v.quantity, v_value);
  if (carries(table, &bsdf::Point::theta_i) && carries(table, &bsdf::Point::theta_o))
    point.theta_d = (point.theta_o - point.theta_i) / 2;
  if (is_from_caustic(table)) set_beside_caustic(point, u_value, size, caustic_index);
  return point;
}

bsdf::Point point_read(const TableLayout& table, bsdf::Point point) {
  if (table.u.quantity == AxisQuantity::abs_theta_o || table.v.quantity == AxisQuantity::abs_theta_o)
    point.theta_d = std::abs(point.theta_o);
  return point;
}

double left_out_factor(const TableLayout& table, const bsdf::Point& point, double caustic_index) {
  return is_from_caustic(table) ? place_beside(point, 2, caustic_index).peak : 1;
}

namespace {

/// What a shader computes of both directions for an axis of the half vector.
double value_of_both(AxisQuantity quantity, const bsdf::Point& at) {
  const double cos_i = std::cos(at.theta_i), cos_phi = std::cos(at.phi);
  if (quantity == AxisQuantity::cos_normal) return cos_i * cos_phi;
  const auto half = half_angles<double>({std::sin(at.theta_i), cos_i}, {std::sin(at.theta_o), std::cos(at.theta_o)},
                                        cos_phi, std::abs(std::sin(at.phi)));
  if (quantity == AxisQuantity::theta_between) return half.between;
  if (quantity == AxisQuantity::theta_half) return half.inclination;
  return half.azimuth;
}

}  // namespace

double axis_coordinate(const Axis& axis, int size, const bsdf::Point& point, double caustic_index) {
  const AxisInfo& info = axis_info(axis.quantity);
  const AxisMap map = axis_map(axis, size);
  if (axis.quantity == AxisQuantity::from_caustic)
    return place_beside(point, size, caustic_index).value * map.scale + map.bias;
  if (axis.quantity == AxisQuantity::abs_theta_o) return std::abs(point.theta_o) * map.scale + map.bias;
  if (is_of_half_vector(axis.quantity)) return value_of_both(axis.quantity, point) * map.scale + map.bias;
  return info.angle ? info.from_angle(point.*info.angle) * map.scale + map.bias : map.bias;
}

double axis_angle(const Axis& axis, int size, double coordinate) {
  const AxisInfo& info = axis_info(axis.quantity);
  return info.to_angle(std::clamp(axis_value(axis, size, coordinate), info.lower, info.upper));
}

}  // namespace cuticle::lut
