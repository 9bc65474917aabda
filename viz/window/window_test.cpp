// Windows on a virtual display: sliders moved and strands picked by events of the mouse.
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkPolyData.h>
#include <vtkRendererCollection.h>

#include "core/file.h"
#include "strands/formats/vtp/vtp.h"
#include "tests/support/temporary_folder.h"
#include "viz/lobes/lobes_view.h"
#include "viz/strands/strands_view.h"
#include "viz/window/detail/interaction.h"
#include "viz/window/detail/open_window.h"

namespace cuticle::viz::window_test {
namespace {

void send(vtkRenderWindowInteractor& interactor, unsigned long event, const glm::ivec2& at) {
  interactor.SetEventInformation(at.x, at.y);
  interactor.InvokeEvent(event);
}
void drag(vtkRenderWindowInteractor& interactor, const glm::ivec2& from, const glm::ivec2& to) {
  send(interactor, vtkCommand::LeftButtonPressEvent, from);
  send(interactor, vtkCommand::MouseMoveEvent, to);
  send(interactor, vtkCommand::LeftButtonReleaseEvent, to);
}

LobesView marschner_view() {
  const bsdf::Model* model = bsdf::find_model("marschner").value();
  LobesView view;
  view.models = {{model, registry::default_values(model->entry.parameters)}};
  view.settings = {0.5, "TT", false};
  return view;
}

double radius_at(const LobesPicture& picture, int row, int column) {
  double p[3];
  picture.scene(0).surface_data()->GetPoint(row * DirectionGrid{}.columns + column, p);
  return std::hypot(p[0], p[1], p[2]);
}

double model_value(const LobesPicture& picture, int row, int column) {
  const ShownModel& shown = picture.shown().models[0];
  const bsdf::Point point{.theta_i = picture.shown().settings.theta_i,
                          .theta_o = DirectionGrid{}.theta_o(row),
                          .phi = DirectionGrid{}.phi(column)};
  glm::dvec3 value;
  EXPECT_TRUE(bsdf::evaluate(*shown.model, shown.values, bsdf::Precision::f64,
                             {bsdf::Quantity::S, 1, std::span(&point, 1)}, std::span(&value, 1))
                  .ok());
  return (value.x + value.y + value.z) / 3;
}

TEST(LobesWindow, SliderMoved_ChangesTheSurfaceAsTheModelSays) {
  LobesPicture picture(marschner_view());
  ViewTarget target;
  target.size = {1000, 760};
  const OpenWindow opened = open_window(picture, target, true).value();
  Interaction interaction(picture, opened.area, target);
  opened.window->Render();
  const int row = 47, column = 350;
  const double before = radius_at(picture, row, column) * picture.peak();
  drag(interaction.interactor(), interaction.knob("beta", 11.4592), interaction.knob("beta", 20));
  const double beta = picture.shown().models[0].values.real("beta") * 180 / 3.14159265358979;
  EXPECT_NEAR(beta, 20, 0.5);
  const double after = radius_at(picture, row, column) * picture.peak();
  EXPECT_GT(std::abs(after - before), 0.05 * before);
  EXPECT_NEAR(after, model_value(picture, row, column), 3e-3 * picture.peak());
}

TEST(LobesWindow, LightDragged_ChangesItsInclination) {
  LobesPicture picture(marschner_view());
  ViewTarget target;
  target.size = {1000, 760};
  const OpenWindow opened = open_window(picture, target, true).value();
  Interaction interaction(picture, opened.area, target);
  opened.window->Render();
  vtkRenderer& renderer = *opened.window->GetRenderers()->GetFirstRenderer();
  const auto pixel = [&](double theta) {
    renderer.SetWorldPoint(1.2 * std::cos(theta), 0, 1.2 * std::sin(theta), 1);
    renderer.WorldToDisplay();
    return glm::ivec2(int(renderer.GetDisplayPoint()[0]), int(renderer.GetDisplayPoint()[1]));
  };
  drag(interaction.interactor(), pixel(0.5), pixel(0.2));
  EXPECT_NEAR(picture.shown().settings.theta_i, 0.2, 0.02);
}

using StrandsWindow = tests::TemporaryFolder;

TEST_F(StrandsWindow, StrandPicked_ReportsTheNumbersOfTheFile) {
  strands::Groom groom;
  groom.offsets = {0, 3, 6};
  groom.positions = {{0, 0, 0}, {0, -0.1F, 0}, {0, -0.2F, 0}, {0.1F, 0, 0}, {0.1F, -0.1F, 0}, {0.1F, -0.2F, 0}};
  groom.radii.assign(6, 1e-5F);
  const std::vector<glm::vec3> velocities(6, {0.25F, 0, 0});
  const std::vector<float> stretch = {1, 1.01F, 1.02F, 1, 0.9F, 1.125F};
  ASSERT_TRUE(
      write_text_file(path("state.vtp"), strands::format_vtp({&groom, groom.positions, velocities, stretch})).ok());
  StrandsView view;
  view.runs = {find_run(path("state.vtp")).value()};
  StrandsPicture picture(view);
  ViewTarget target;
  target.size = {1000, 760};
  const OpenWindow opened = open_window(picture, target, true).value();
  Interaction interaction(picture, opened.area, target);
  opened.window->Render();
  vtkRenderer& renderer = *opened.window->GetRenderers()->GetFirstRenderer();
  renderer.SetWorldPoint(0.1, -0.2, 0, 1);
  renderer.WorldToDisplay();
  const glm::ivec2 at(int(renderer.GetDisplayPoint()[0] + 1.5), int(renderer.GetDisplayPoint()[1] + 0.5));
  testing::internal::CaptureStdout();
  send(interaction.interactor(), vtkCommand::LeftButtonPressEvent, at);
  send(interaction.interactor(), vtkCommand::LeftButtonReleaseEvent, at);
  const std::string words = testing::internal::GetCapturedStdout();
  EXPECT_TRUE(interaction.result().ok());
  EXPECT_TRUE(renderer.IsInViewport(at.x, at.y)) << at.x << " " << at.y;
  EXPECT_THAT(words,
              testing::AllOf(testing::HasSubstr("strand,1\n"), testing::HasSubstr("stretch,1.125\n"),
                             testing::HasSubstr("y_m,-0.200000003\n"), testing::HasSubstr("velocity,0.25,0,0\n")));
}

}  // namespace
}  // namespace cuticle::viz::window_test
