#include "viz/window/detail/interaction.h"

#include <cstdio>
#include <cstdlib>
#include <optional>

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>

#include "core/file.h"
#include "viz/window/detail/panel.h"
#include "viz/window/picture.h"

namespace cuticle::viz {

struct Interaction::State {
  State(View& shown, const WindowArea& part, const ViewTarget& where);
  void listen();
  void handle(unsigned long event, vtkCallbackCommand& command);
  bool press(const glm::ivec2& at);
  bool move(const glm::ivec2& at);
  bool release(const glm::ivec2& at);
  void press_key(char key);
  void next_frame();
  void set_moving(bool moving);
  void print_control() const;
  void pick(const glm::ivec2& at);
  glm::ivec2 mouse() const;
  void redraw() { area.window->Render(); }
  void keep(const Result<void>& done);

  View& view;
  WindowArea area;
  ViewTarget target;
  vtkNew<vtkRenderWindowInteractor> interactor;
  vtkSmartPointer<Panel> panel = vtkSmartPointer<Panel>::New();
  vtkNew<vtkCallbackCommand> command;
  std::optional<Error> error;
  std::optional<glm::ivec2> pressed_at;
  int row = -1;
  bool holds = false, plays = false;
  int timer = 0, frame = 0;
};

Interaction::State::State(View& shown, const WindowArea& part, const ViewTarget& where)
    : view(shown), area(part), target(where) {
  panel->scale = area.scale;
  panel->set(view.controls());
  panel->say("drag: turn   wheel: zoom   click: pick   space: play\nx: write files   s: picture   q: close");
  const WindowArea whole{area.window, 0, area.scale};
  const auto renderer = whole.add_renderer(0, 0, area.left, 1);
  renderer->SetBackground(0.96, 0.965, 0.97);
  renderer->InteractiveOff();
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(panel);
  renderer->AddActor(actor);
  vtkNew<vtkInteractorStyleTrackballCamera> style;
  interactor->SetInteractorStyle(style);
  interactor->SetRenderWindow(area.window);
  listen();
}

void Interaction::State::listen() {
  command->SetClientData(this);
  command->SetCallback([](vtkObject*, unsigned long event, void* state, void*) {
    auto& self = *static_cast<State*>(state);
    self.handle(event, *self.command);
  });
  for (const unsigned long event : {vtkCommand::LeftButtonPressEvent, vtkCommand::MouseMoveEvent,
                                    vtkCommand::LeftButtonReleaseEvent, vtkCommand::MouseWheelForwardEvent,
                                    vtkCommand::MouseWheelBackwardEvent, vtkCommand::CharEvent, vtkCommand::TimerEvent})
    interactor->AddObserver(event, command, 1.0F);
  vtkObject& style = *interactor->GetInteractorStyle();
  style.AddObserver(vtkCommand::StartInteractionEvent, command);
  style.AddObserver(vtkCommand::EndInteractionEvent, command);
}

glm::ivec2 Interaction::State::mouse() const {
  const int* at = interactor->GetEventPosition();
  return {at[0], at[1]};
}

void Interaction::State::keep(const Result<void>& done) {
  if (done || error) return;
  error = done.error();
  interactor->TerminateApp();
}

void Interaction::State::handle(unsigned long event, vtkCallbackCommand& caller) {
  bool taken = false;
  const bool on_panel = mouse().x < area.left * area.window->GetSize()[0];
  switch (event) {
    case vtkCommand::LeftButtonPressEvent:
      taken = press(mouse());
      break;
    case vtkCommand::MouseMoveEvent:
      taken = move(mouse());
      break;
    case vtkCommand::LeftButtonReleaseEvent:
      taken = release(mouse());
      break;
    case vtkCommand::StartInteractionEvent:
      set_moving(true);
      break;
    case vtkCommand::EndInteractionEvent:
      set_moving(false);
      break;
    case vtkCommand::CharEvent:
      press_key(interactor->GetKeyCode()), taken = true;
      break;
    case vtkCommand::TimerEvent:
      next_frame();
      break;
    default:
      taken = on_panel;
      if (on_panel) panel->scroll(event == vtkCommand::MouseWheelForwardEvent ? -1 : 1), redraw();
  }
  caller.SetAbortFlag(taken);
}

bool Interaction::State::press(const glm::ivec2& at) {
  pressed_at = at;
  if (at.x < area.left * area.window->GetSize()[0]) {
    row = panel->row_at(at);
    if (row >= 0) keep(panel->set_by_mouse(row, at, true, false)), redraw();
    return true;
  }
  holds = view.grab(at);
  return holds;
}

bool Interaction::State::move(const glm::ivec2& at) {
  if (row >= 0) {
    keep(panel->set_by_mouse(row, at, false, false));
  } else if (holds) {
    keep(view.drag(at, false));
    panel->set(view.controls());
  } else {
    return false;
  }
  redraw();
  return true;
}

bool Interaction::State::release(const glm::ivec2& at) {
  const bool taken = row >= 0 || holds;
  if (row >= 0) keep(panel->set_by_mouse(row, at, false, true)), print_control();
  if (holds) keep(view.drag(at, true));
  if (taken) panel->set(view.controls()), redraw();
  row = -1;
  holds = false;
  pressed_at.reset();
  return taken;
}

void Interaction::State::print_control() const {
  const Control& control = panel->controls()[std::size_t(row)];
  const bool is_choice = !control.choices.empty();
  fmt::print("{},{}\n", control.name, is_choice ? value_text(control) : fmt::format("{:.9g}", control.value));
  std::fflush(stdout);
}

void Interaction::State::pick(const glm::ivec2& at) {
  const Result<std::string> found = view.pick(at);
  if (!found) return keep(found.error());
  if (found->empty()) return;
  fmt::print("{}", *found);
  std::fflush(stdout);
  redraw();
}

void Interaction::State::press_key(char key) {
  if (key == 'q') interactor->TerminateApp();
  const std::string folder = target.export_folder.empty() ? "view_export" : target.export_folder;
  if (key == 'x' || key == 's') keep(make_folder(folder));
  if (key == 'x') keep(view.write_files(folder));
  if (key == 's') keep(write_picture(*area.window, folder + "/picture.png"));
  if (key == ' ' && view.frame_count() > 1) plays = !plays;
  if (key == 'x' || key == 's') fmt::print("written: {}\n", folder), std::fflush(stdout);
}

void Interaction::State::next_frame() {
  if (!plays) return;
  frame = (frame + 1) % view.frame_count();
  keep(view.show_frame(frame));
  panel->set(view.controls());
  redraw();
}

/// While the camera turns, its style alone hears of the mouse: a turn that ends where it began was a click.
void Interaction::State::set_moving(bool moving) {
  view.set_moving(moving);
  area.window->SetMultiSamples(moving ? 0 : k_samples);
  if (moving) return;
  const bool was_click = pressed_at && *pressed_at == mouse();
  pressed_at.reset();
  if (was_click) pick(mouse());
  redraw();
}

Interaction::Interaction(View& view, const WindowArea& area, const ViewTarget& target)
    : state_(std::make_unique<State>(view, area, target)) {}
Interaction::~Interaction() = default;
vtkRenderWindowInteractor& Interaction::interactor() { return *state_->interactor; }

glm::ivec2 Interaction::knob(const std::string& control, double value) const {
  const auto& controls = state_->panel->controls();
  for (int row = 0; row < int(controls.size()); ++row)
    if (controls[std::size_t(row)].name == control) return glm::ivec2(state_->panel->knob(row, value));
  return glm::ivec2(-1);
}

Result<void> Interaction::result() const {
  if (state_->error) return *state_->error;
  return {};
}

Result<void> interact(View& view, const WindowArea& area, const ViewTarget& target) {
  Interaction interaction(view, area, target);
  area.window->Render();
  interaction.interactor().Initialize();
  interaction.interactor().CreateRepeatingTimer(1000 / std::max(1, target.frames_per_second));
  interaction.interactor().Start();
  return interaction.result();
}

}  // namespace cuticle::viz
