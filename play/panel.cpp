#include "play/panel.h"

#include <imgui.h>

#include <fmt/core.h>

namespace cuticle::play {

namespace {

using registry::Parameter, registry::ParameterType, registry::Value;

/// A control's label, hidden: its text stands above it.
std::string hidden(std::string_view name) { return fmt::format("##{}", name); }

struct Controls {
  const Session& session;
  Actions& actions;
  std::vector<ControlPlace> places;

  void note(std::string name) {
    const ImVec2 low = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
    places.push_back({std::move(name), int(low.x), int(low.y), int(size.x), int(size.y)});
  }
  bool button(const char* label, const char* name) {
    const bool pressed = ImGui::Button(label);
    note(name);
    return pressed;
  }
  void transport();
  void method();
  void group(const ParameterGroup& group);
  void parameter(const ParameterGroup& group, const Parameter& parameter);
  void costs();
};

void Controls::transport() {
  actions.toggle_pause |= button(session.is_paused() ? "Play" : "Pause", "pause");
  ImGui::SameLine();
  actions.step |= button("Step", "step");
  ImGui::SameLine();
  actions.restart |= button("Restart", "restart");
  ImGui::Text("frame %d, %.0f ms; last change %.0f ms", session.frame(), session.cost().frame_ms,
              session.cost().change_ms);
}

void Controls::method() {
  const std::string& current = session.scene().render_method;
  ImGui::TextUnformatted("method");
  if (ImGui::BeginCombo("##method", current.c_str())) {
    for (const std::string_view name : scene::k_render_methods)
      if (ImGui::Selectable(std::string(name).c_str(), name == current) && name != current) actions.method = name;
    ImGui::EndCombo();
  }
  note("method");
}

/// Ranges of several decades are moved through by their logarithm.
ImGuiSliderFlags flags_of(const Parameter& parameter) {
  const bool wide = parameter.minimum >= 0 && parameter.maximum > 50;
  return ImGuiSliderFlags_AlwaysClamp | (wide ? ImGuiSliderFlags_Logarithmic : 0);
}

bool edit_number(const Parameter& parameter, double* numbers, int count) {
  return ImGui::SliderScalarN(hidden(parameter.name).c_str(), ImGuiDataType_Double, numbers, count, &parameter.minimum,
                              &parameter.maximum, "%.4g", flags_of(parameter));
}

bool edit_integer(const Parameter& parameter, std::int64_t& number) {
  const auto lowest = std::int64_t(parameter.minimum), highest = std::int64_t(parameter.maximum);
  return ImGui::SliderScalar(hidden(parameter.name).c_str(), ImGuiDataType_S64, &number, &lowest, &highest, "%lld",
                             flags_of(parameter));
}

bool edit_choice(const Parameter& parameter, std::string& chosen) {
  if (!ImGui::BeginCombo(hidden(parameter.name).c_str(), chosen.c_str())) return false;
  bool edited = false;
  for (const std::string_view choice : parameter.choices)
    if (ImGui::Selectable(std::string(choice).c_str(), choice == chosen) && choice != chosen) {
      chosen = choice;
      edited = true;
    }
  ImGui::EndCombo();
  return edited;
}

bool edit(const Parameter& parameter, Value& value) {
  switch (parameter.type) {
    case ParameterType::real:
      return edit_number(parameter, &std::get<double>(value), 1);
    case ParameterType::rgb:
      return edit_number(parameter, &std::get<glm::dvec3>(value)[0], 3);
    case ParameterType::integer:
      return edit_integer(parameter, std::get<std::int64_t>(value));
    case ParameterType::boolean:
      return ImGui::Checkbox(hidden(parameter.name).c_str(), &std::get<bool>(value));
    case ParameterType::choice:
      return edit_choice(parameter, std::get<std::string>(value));
  }
  return false;
}

void Controls::parameter(const ParameterGroup& group, const Parameter& parameter) {
  ImGui::TextUnformatted(fmt::format("{} [{}]", parameter.name, parameter.unit).c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", std::string(parameter.summary).c_str());
  Value value = group.values.all().find(parameter.name)->second;
  if (edit(parameter, value))
    actions.changes.push_back(
        {group.entry->kind, std::string(group.entry->name), std::string(parameter.name), std::move(value)});
  note(fmt::format("{}.{}", group.entry->name, parameter.name));
}

void Controls::group(const ParameterGroup& group) {
  const std::string name(group.entry->name);
  const bool is_material = group.entry->kind == registry::EntryKind::model;
  if (!ImGui::CollapsingHeader(name.c_str(), is_material ? ImGuiTreeNodeFlags_DefaultOpen : 0)) return;
  ImGui::PushID(group.entry);
  for (const Parameter& one : group.entry->parameters) parameter(group, one);
  ImGui::PopID();
}

void Controls::costs() {
  if (!ImGui::CollapsingHeader("cost of each pass", ImGuiTreeNodeFlags_DefaultOpen)) return;
  const gpu::SubmitCost& cost = session.shown().cost;
  ImGui::Text("%.1f ms of submitted work by wall clock", cost.wall_ms);
  for (const gpu::PassCost& pass : cost.passes) ImGui::Text("%-20s %8.3f ms", pass.name.c_str(), pass.gpu_ms);
  ImGui::TextUnformatted("(passes by the device's timestamps)");
}

}  // namespace

std::vector<ControlPlace> draw_panel(const Session& session, Actions& actions) {
  Controls controls{session, actions, {}};
  controls.transport();
  controls.method();
  for (const ParameterGroup& group : session.groups()) controls.group(group);
  controls.costs();
  return std::move(controls.places);
}

}  // namespace cuticle::play
