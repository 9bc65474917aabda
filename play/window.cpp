#include "play/window.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/core.h>
#include <glm/common.hpp>

namespace cuticle::play {

namespace {

constexpr int k_panel_width = 340, k_least_side = 480;
constexpr double k_refresh_seconds = 0.05;

Error no_window(const std::string& what) {
  const char* why = nullptr;
  glfwGetError(&why);
  return {ErrorKind::no_device, fmt::format("{}: {}", what, why ? why : "no reason given"),
          "a display and OpenGL 3 are needed; `cuticle render` writes pictures without them"};
}

/// GLFW, its window with a context of OpenGL 3.0, and ImGui in it; gone with this object.
class Window {
 public:
  ~Window() {
    if (ImGui::GetCurrentContext()) {
      if (drawn_by_gl_) ImGui_ImplOpenGL3_Shutdown();
      if (heard_by_imgui_) ImGui_ImplGlfw_Shutdown();
      ImGui::DestroyContext();
    }
    if (handle_) glfwDestroyWindow(handle_);
    glfwTerminate();
  }
  Result<void> open(glm::ivec2 size, const std::string& title);
  GLFWwindow* handle() const { return handle_; }

 private:
  GLFWwindow* handle_ = nullptr;
  bool heard_by_imgui_ = false, drawn_by_gl_ = false;
};

Result<void> Window::open(glm::ivec2 size, const std::string& title) {
  if (!glfwInit()) return no_window("no window system");
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 0);
  handle_ = glfwCreateWindow(size.x, size.y, title.c_str(), nullptr, nullptr);
  if (!handle_) return no_window("no window");
  glfwMakeContextCurrent(handle_);
  glfwSwapInterval(0);
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  heard_by_imgui_ = ImGui_ImplGlfw_InitForOpenGL(handle_, true);
  drawn_by_gl_ = ImGui_ImplOpenGL3_Init("#version 130");
  if (!heard_by_imgui_ || !drawn_by_gl_) return no_window("no OpenGL");
  return {};
}

/// The picture as a texture of OpenGL.
class Canvas {
 public:
  void fill(const Image& linear, double exposure_stops) {
    const Image shown = tone_map(linear, exposure_stops);
    bytes_.resize(shown.pixels.size());
    std::ranges::transform(shown.pixels, bytes_.begin(),
                           [](float value) { return std::uint8_t(std::lround(255 * std::clamp(value, 0.0f, 1.0f))); });
    for (std::size_t p = 3; p < bytes_.size(); p += 4) bytes_[p] = 255;
    size_ = {shown.width, shown.height};
    if (!texture_) glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, size_.x, size_.y, 0, GL_RGBA, GL_UNSIGNED_BYTE, bytes_.data());
  }
  /// As large as fits, in its own shape; takes the mouse.
  void draw() const {
    const ImVec2 room = ImGui::GetContentRegionAvail();
    const float scale = std::min(room.x / float(size_.x), room.y / float(size_.y));
    const ImVec2 at = ImGui::GetCursorPos(), size{scale * float(size_.x), scale * float(size_.y)};
    ImGui::Image(reinterpret_cast<ImTextureID>(std::intptr_t(texture_)), size);
    ImGui::SetCursorPos(at);
    ImGui::InvisibleButton("picture", size, ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  }

 private:
  GLuint texture_ = 0;
  glm::ivec2 size_{1};
  std::vector<std::uint8_t> bytes_;
};

CameraMove camera_move() {
  CameraMove move;
  const ImGuiIO& io = ImGui::GetIO();
  const ImVec2 size = ImGui::GetItemRectSize();
  const glm::dvec2 drag(io.MouseDelta.x / size.x, io.MouseDelta.y / size.y);
  if (ImGui::IsItemActive() && io.MouseDown[ImGuiMouseButton_Left]) move.turn = 2 * std::numbers::pi * drag;
  if (ImGui::IsItemActive() && io.MouseDown[ImGuiMouseButton_Right])
    move.shift = {drag.x * double(size.x) / double(size.y), drag.y};
  if (ImGui::IsItemHovered()) move.distance = std::pow(0.9, double(io.MouseWheel));
  return move;
}

void read_keys(GLFWwindow* window, Actions& actions) {
  if (ImGui::GetIO().WantTextInput) return;
  actions.toggle_pause |= ImGui::IsKeyPressed(GLFW_KEY_SPACE, false);
  actions.step |= ImGui::IsKeyPressed(GLFW_KEY_PERIOD);
  actions.restart |= ImGui::IsKeyPressed(GLFW_KEY_R, false);
  if (ImGui::IsKeyPressed(GLFW_KEY_ESCAPE, false)) glfwSetWindowShouldClose(window, GLFW_TRUE);
}

/// One refresh of the window; gives what was done.
Actions draw_window(GLFWwindow* window, const Session& session, const Canvas& canvas, WindowReport& report,
                    const std::string& refused) {
  constexpr ImGuiWindowFlags fixed =
      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoTitleBar;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  Actions actions;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize({std::max(64.0f, size.x - k_panel_width), size.y});
  ImGui::Begin("picture", nullptr, fixed | ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoScrollbar);
  canvas.draw();
  actions.camera = camera_move();
  ImGui::End();
  ImGui::SetNextWindowPos({std::max(64.0f, size.x - k_panel_width), 0});
  ImGui::SetNextWindowSize({k_panel_width, size.y});
  ImGui::Begin("controls", nullptr, fixed);
  if (!refused.empty()) ImGui::TextWrapped("%s", refused.c_str());
  report.controls = draw_panel(session, actions);
  ImGui::End();
  read_keys(window, actions);
  ImGui::Render();
  return actions;
}

void present(GLFWwindow* window) {
  glm::ivec2 size;
  glfwGetFramebufferSize(window, &size.x, &size.y);
  glViewport(0, 0, size.x, size.y);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

Image window_picture(GLFWwindow* window) {
  glm::ivec2 size;
  glfwGetFramebufferSize(window, &size.x, &size.y);
  std::vector<std::uint8_t> bytes(3 * std::size_t(size.x) * std::size_t(size.y));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
  Image image = make_image(size.x, size.y, {"R", "G", "B"});
  const std::size_t row = 3 * std::size_t(size.x);
  for (std::size_t y = 0; y < std::size_t(size.y); ++y)  // OpenGL's first row is the lowest
    std::transform(bytes.begin() + std::ptrdiff_t(y * row), bytes.begin() + std::ptrdiff_t((y + 1) * row),
                   image.pixels.end() - std::ptrdiff_t((y + 1) * row), [](std::uint8_t b) { return float(b) / 255; });
  return image;
}

bool ends(GLFWwindow* window, const WindowOptions& options, const WindowReport& report) {
  return glfwWindowShouldClose(window) || (options.pictures > 0 && report.pictures >= options.pictures);
}

}  // namespace

Result<WindowReport> show(Session& session, const WindowOptions& options) {
  Window window;
  const glm::ivec2 picture = session.camera().resolution;
  CUTICLE_TRY(window.open(glm::max(picture, k_least_side) + glm::ivec2(k_panel_width, 0), "Cuticle"));
  Canvas canvas;
  WindowReport report;
  std::string refused;
  for (Actions actions;;) {
    const Result<bool> advanced = session.advance(actions);
    if (!advanced && report.pictures == 0) return advanced.error();
    refused = advanced ? (actions.changes.empty() ? refused : "") : advanced.error().message;
    const bool is_new = advanced && *advanced;
    if (is_new) {
      canvas.fill(session.shown().color, session.scene().outputs.exposure_stops);
      ++report.pictures;
    }
    // A picture that stands still needs no more than a look at what the user does.
    is_new ? glfwPollEvents() : glfwWaitEventsTimeout(k_refresh_seconds);
    actions = draw_window(window.handle(), session, canvas, report, refused);
    present(window.handle());
    if (ends(window.handle(), options, report)) break;
    glfwSwapBuffers(window.handle());
  }
  if (!options.screenshot.empty()) CUTICLE_TRY(write_png(options.screenshot, window_picture(window.handle())));
  return report;
}

}  // namespace cuticle::play
