// What stands about strands in their view: colliders, the growth mesh, hair's density as a volume.
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "viz/draw/detail/volume.h"
#include "viz/strands/strands_view.h"

namespace cuticle::viz {
namespace {

vtkSmartPointer<vtkActor> lit(vtkPolyDataMapper* mapper, const glm::dvec3& color) {
  mapper->ScalarVisibilityOff();
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(color.x, color.y, color.z);
  actor->GetProperty()->SetAmbient(0.25);
  actor->GetProperty()->SetDiffuse(0.75);
  return actor;
}

vtkSmartPointer<vtkActor> mesh_actor(const strands::Mesh& mesh, const glm::dvec3& color) {
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  for (const glm::vec3& p : mesh.positions) points->InsertNextPoint(double(p.x), double(p.y), double(p.z));
  for (const glm::vec3& n : mesh.normals) normals->InsertNextTuple3(double(n.x), double(n.y), double(n.z));
  vtkNew<vtkCellArray> triangles;
  for (const auto& t : mesh.triangles) triangles->InsertNextCell({vtkIdType(t[0]), vtkIdType(t[1]), vtkIdType(t[2])});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(triangles);
  if (mesh.normals.size() == mesh.positions.size()) data->GetPointData()->SetNormals(normals);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(data);
  return lit(mapper, color);
}

/// The level 0 of a distance field.
vtkSmartPointer<vtkActor> field_actor(const sim::DistanceField& field, const Placement& place,
                                      const glm::dvec3& color) {
  vtkNew<vtkImageData> image;
  const glm::dvec3 origin = field.centre - 0.5 * field.spacing * glm::dvec3(field.cells);
  image->SetDimensions(field.cells.x + 1, field.cells.y + 1, field.cells.z + 1);
  image->SetOrigin(origin.x, origin.y, origin.z);
  image->SetSpacing(field.spacing, field.spacing, field.spacing);
  image->AllocateScalars(VTK_FLOAT, 1);
  std::copy(field.values.begin(), field.values.end(), static_cast<float*>(image->GetScalarPointer()));
  vtkNew<vtkFlyingEdges3D> surface;
  surface->SetInputData(image);
  surface->SetValue(0, 0);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  const glm::dmat4 placed = glm::translate(glm::dmat4(1), place.position) * glm::mat4_cast(place.rotation);
  vtkNew<vtkMatrix4x4> matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix->SetElement(row, column, placed[column][row]);
  const auto actor = lit(mapper, color);
  actor->SetUserMatrix(matrix);
  return actor;
}

}  // namespace

/// The run's own colliders where they stand in its frame, and those given.
void StrandsPicture::draw_colliders(Part& part) {
  constexpr glm::dvec3 color(0.8, 0.78, 0.75);
  std::vector<sim::PlacedCollider> colliders = part.run.colliders_at(shown_frame(part));
  for (const Sphere& sphere : view_.coloring.colliders) colliders.push_back({sphere, {}});
  for (const sim::PlacedCollider& collider : colliders) {
    const auto* field = std::get_if<sim::FieldPointer>(&collider.shape);
    part.around.push_back(field ? field_actor(**field, collider.place, color)
                                : mesh_actor(surface_of(collider), color));
  }
}

Result<void> StrandsPicture::draw_density(Part& part) {
  CUTICLE_ASSIGN(const VolumeGrid density, hair_density(part.groom, view_.density_cell));
  if (!density_scale_) density_scale_ = sequential_scale(density.values, "length of hair per volume [mm/mm^3]");
  part.around.push_back(make_volume(density.size, density.origin, glm::dvec3(density.spacing), density.values,
                                    *density_scale_,
                                    [](double fraction) { return fraction == 0 ? 0 : 0.02 + 0.6 * fraction; }));
  bar_->set(*density_scale_);
  return {};
}

Result<void> StrandsPicture::draw_surroundings(Part& part) {
  for (const auto& prop : part.around) part.renderer->RemoveViewProp(prop);
  part.around.clear();
  draw_colliders(part);
  if (view_.mesh) {
    const strands::Mesh carried = strands::transformed(*view_.mesh, part.run.head_at(shown_frame(part)));
    part.around.push_back(mesh_actor(carried, {0.86, 0.82, 0.78}));
  }
  if (view_.density_cell > 0) CUTICLE_TRY(draw_density(part));
  for (const auto& prop : part.around) part.renderer->AddViewProp(prop);
  return {};
}

}  // namespace cuticle::viz
