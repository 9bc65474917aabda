// The panel of the view of lobes: a row for every parameter of the models.
#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "viz/lobes/lobes_view.h"
#include "viz/lobes/numbers.h"

namespace cuticle::viz {
namespace {

constexpr const char* k_components[] = {".r", ".g", ".b"};

/// Angles are shown in degrees.
bool is_angle(const registry::Parameter& parameter) { return parameter.unit == "rad"; }
double unit_of(const registry::Parameter& parameter) { return is_angle(parameter) ? k_degree : 1; }

std::vector<std::string> choices_of(const registry::Parameter& parameter) {
  if (parameter.type == registry::ParameterType::boolean) return {"false", "true"};
  return {parameter.choices.begin(), parameter.choices.end()};
}

double shown_value(const registry::Value& value, const std::vector<std::string>& choices, int component) {
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return double(*integer);
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? 1 : 0;
  if (const auto* color = std::get_if<glm::dvec3>(&value)) return (*color)[component];
  const auto& name = std::get<std::string>(value);
  return double(std::find(choices.begin(), choices.end(), name) - choices.begin());
}

registry::Value with_value(const registry::Value& now, const std::vector<std::string>& choices, int component,
                           double value) {
  if (std::holds_alternative<double>(now)) return value;
  if (std::holds_alternative<std::int64_t>(now)) return std::int64_t(value);
  if (std::holds_alternative<bool>(now)) return value > 0.5;
  if (const auto* color = std::get_if<glm::dvec3>(&now)) {
    glm::dvec3 changed = *color;
    changed[component] = value;
    return changed;
  }
  return choices[std::size_t(value)];
}

/// Tables give wide ranges so that nothing is refused; a slider spans what hair has.
double slider_end(const registry::Parameter& parameter) {
  if (parameter.name.starts_with("sigma_a")) return std::min(parameter.maximum, 5.0);
  return parameter.maximum;
}

}  // namespace

Result<void> LobesPicture::set_parameter(std::size_t model, const registry::Parameter& parameter, int component,
                                         double value, bool resting) {
  registry::ParameterValues& values = view_.models[model].values;
  const registry::Value& now = values.all().at(std::string(parameter.name));
  values.set(parameter.name, with_value(now, choices_of(parameter), component, value * unit_of(parameter)));
  return update(resting);
}

void LobesPicture::add_parameter(std::vector<Control>& list, std::size_t model, const registry::Parameter& parameter) {
  const registry::Value& now = view_.models[model].values.all().at(std::string(parameter.name));
  const bool is_color = parameter.type == registry::ParameterType::rgb;
  for (int component = 0; component < (is_color ? 3 : 1); ++component) {
    const double unit = unit_of(parameter);
    Control control{
        fmt::format("{}{}{}", view_.models.size() == 2 ? view_.models[model].model->entry.name.substr(0, 4) : "",
                    view_.models.size() == 2 ? " " : "", parameter.name) +
            (is_color ? k_components[component] : ""),
        is_angle(parameter) ? "deg" : std::string(parameter.unit), parameter.minimum / unit,
        slider_end(parameter) / unit};
    control.choices = choices_of(parameter);
    control.is_integer = parameter.type == registry::ParameterType::integer;
    control.value = shown_value(now, control.choices, component) / unit;
    control.set = [this, model, &parameter, component](double value, bool resting) {
      return set_parameter(model, parameter, component, value, resting);
    };
    list.push_back(std::move(control));
  }
}

std::vector<Control> LobesPicture::controls() {
  std::vector<Control> list;
  list.push_back(
      {"theta_i", "deg", -89, 89, view_.settings.theta_i / k_degree, {}, false, [this](double value, bool resting) {
         view_.settings.theta_i = value * k_degree;
         return update(resting);
       }});
  list.push_back({"radius",
                  "",
                  0,
                  1,
                  view_.settings.logarithmic ? 0.0 : 1.0,
                  {"log", "linear"},
                  false,
                  [this](double value, bool resting) {
                    view_.settings.logarithmic = value < 0.5;
                    return update(resting);
                  }});
  if (std::any_of(view_.models.begin(), view_.models.end(), is_near_field))
    list.push_back({"h", "1", -1, 1, view_.settings.h, {}, false, [this](double value, bool resting) {
                      view_.settings.h = value;
                      return update(resting);
                    }});
  for (std::size_t model = 0; model < view_.models.size(); ++model)
    for (const registry::Parameter& parameter : view_.models[model].model->entry.parameters)
      add_parameter(list, model, parameter);
  return list;
}

}  // namespace cuticle::viz
