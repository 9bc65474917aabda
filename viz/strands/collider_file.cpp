#include "viz/strands/collider_file.h"

#include <filesystem>
#include <sstream>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/gtc/quaternion.hpp>
#include <pugixml.hpp>

#include "core/file.h"
#include "viz/files/vtk_xml.h"

namespace cuticle::viz {
namespace {

Json list_of(const glm::dvec3& v) { return Json::list({v.x, v.y, v.z}); }

glm::dvec3 vector_of(const Json& list) { return {list.at(0).number(), list.at(1).number(), list.at(2).number()}; }

Json matrix_list(const glm::dmat4& matrix) {
  Json list = Json::list();
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) list.push_back(matrix[column][row]);
  return list;
}

glm::dmat4 matrix_of(const Json& list) {
  glm::dmat4 matrix;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) matrix[column][row] = list.at(std::size_t(4 * row + column)).number();
  return matrix;
}

Json shape_of(const Sphere& sphere) {
  return {{"shape", "sphere"}, {"center_m", list_of(sphere.center)}, {"radius_m", sphere.radius}};
}
Json shape_of(const RoundedBox& box) {
  return {{"shape", "box"},
          {"center_m", list_of(box.center)},
          {"axes", Json::list({list_of(box.axes[0]), list_of(box.axes[1]), list_of(box.axes[2])})},
          {"half_size_m", list_of(box.half_size)},
          {"radius_m", box.radius}};
}

template <class T>
std::vector<T> numbers_in(const char* text) {
  std::istringstream stream(text);
  std::vector<T> values;
  for (T value; stream >> value;) values.push_back(value);
  return values;
}

/// One that ColliderWriter wrote.
Result<sim::FieldPointer> read_field(const std::string& file) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(file));
  pugi::xml_document document;
  document.load_buffer(text.data(), text.size());
  const pugi::xml_node image = document.child("VTKFile").child("ImageData");
  const auto extent = numbers_in<int>(image.attribute("WholeExtent").as_string());
  const auto origin = numbers_in<double>(image.attribute("Origin").as_string());
  const double spacing = image.attribute("Spacing").as_double();
  sim::DistanceField field;
  field.spacing = spacing;
  field.values = numbers_in<float>(image.child("Piece").child("PointData").child("DataArray").text().as_string());
  if (extent.size() == 6) field.cells = {extent[1], extent[3], extent[5]};
  const glm::dvec3 nodes(field.cells + 1);
  if (extent.size() != 6 || origin.size() != 3 || !(spacing > 0) || glm::any(glm::lessThan(nodes, glm::dvec3(2))) ||
      double(field.values.size()) != nodes.x * nodes.y * nodes.z)
    return bad_input(file + ": not a distance field of cuticle simulate");
  field.centre = glm::dvec3(origin[0], origin[1], origin[2]) + 0.5 * spacing * glm::dvec3(field.cells);
  return std::make_shared<const sim::DistanceField>(std::move(field));
}

Result<sim::PlacedCollider> read_shape(const Json& json, const std::string& folder) {
  const std::string& kind = json.at("shape").text();
  if (kind == "field") {
    CUTICLE_ASSIGN(sim::FieldPointer field, read_field(folder + "/" + json.at("file").text()));
    return sim::PlacedCollider{std::move(field), {}};
  }
  const glm::dvec3 center = vector_of(json.at("center_m"));
  const double radius = json.at("radius_m").number();
  if (kind == "sphere") return sim::PlacedCollider{Sphere{center, radius}, {}};
  const Json& axes = json.at("axes");
  const glm::dmat3 turned(vector_of(axes.at(0)), vector_of(axes.at(1)), vector_of(axes.at(2)));
  return sim::PlacedCollider{RoundedBox{center, turned, vector_of(json.at("half_size_m")), radius}, {}};
}

Result<RunColliders> read_all(const Json& json, const std::string& folder) {
  RunColliders read;
  for (const Json& shape : json.at("colliders")) {
    CUTICLE_ASSIGN(read.shapes.emplace_back(), read_shape(shape, folder));
  }
  for (const Json& frame : json.at("frames")) {
    const int number = int(frame.at("frame").whole());
    read.heads[number] = matrix_of(frame.at("head"));
    std::vector<Placement>& places = read.places[number];
    for (const Json& n : frame.at("places"))
      places.push_back({{n.at(3).number(), n.at(4).number(), n.at(5).number(), n.at(6).number()}, vector_of(n)});
    if (places.size() != read.shapes.size())
      return bad_input(fmt::format("frame {}: {} places of {} colliders", number, places.size(), read.shapes.size()));
  }
  return read;
}

}  // namespace

std::string format_field(const sim::DistanceField& field, const Placement& place) {
  const glm::dvec3 origin = field.centre - 0.5 * field.spacing * glm::dvec3(field.cells);
  const NamedArray values{"distance", "m", 1, field.values};
  return format_vti(field.cells + 1, place.of(origin), glm::dvec3(field.spacing), {&values, 1},
                    glm::mat3_cast(place.rotation));
}

Result<void> ColliderWriter::add(int frame, std::span<const sim::PlacedCollider> colliders, const glm::dmat4& head,
                                 const std::string& folder) {
  Json places = Json::list();
  for (std::size_t k = 0; k < colliders.size(); ++k) {
    const Placement& place = colliders[k].place;
    places.push_back(Json::list({place.position.x, place.position.y, place.position.z, place.rotation.w,
                                 place.rotation.x, place.rotation.y, place.rotation.z}));
    if (k < shapes_.size()) continue;
    if (const auto* field = std::get_if<sim::FieldPointer>(&colliders[k].shape)) {
      const std::string name = fmt::format("collider_field_{}.vti", k);
      CUTICLE_TRY(write_text_file(folder + "/" + name, format_field(**field)));
      fields_.push_back(name);
      shapes_.push_back({{"shape", "field"}, {"file", name}});
    } else if (const auto* box = std::get_if<RoundedBox>(&colliders[k].shape)) {
      shapes_.push_back(shape_of(*box));
    } else {
      shapes_.push_back(shape_of(std::get<Sphere>(colliders[k].shape)));
    }
  }
  frames_.push_back({{"frame", frame}, {"head", matrix_list(head)}, {"places", std::move(places)}});
  return {};
}

std::string ColliderWriter::text() const {
  const Json all = {{"schema_version", 1},
                    {"about",
                     "colliders in frames of their own; places: x, y, z in metres, then the turn w, x, y, z; "
                     "head: rest to world, by rows"},
                    {"colliders", shapes_},
                    {"frames", frames_}};
  return all.dump(1) + "\n";
}

std::vector<sim::PlacedCollider> RunColliders::at(int frame) const {
  const auto found = places.find(frame);
  if (found == places.end()) return {};
  std::vector<sim::PlacedCollider> placed = shapes;
  for (std::size_t k = 0; k < placed.size(); ++k) placed[k].place = found->second[k];
  return placed;
}

Result<RunColliders> read_colliders(const std::string& folder) {
  const std::string file = folder + "/colliders.json";
  if (!std::filesystem::exists(file)) return RunColliders{};
  CUTICLE_ASSIGN(const std::string text, read_text_file(file));
  const Result<RunColliders> read = [&]() -> Result<RunColliders> {
    CUTICLE_ASSIGN(const Json json, Json::parse(text));
    try {
      return read_all(json, folder);
    } catch (const Json::Mismatch& mismatch) {
      return bad_input(mismatch.what());
    }
  }();
  if (!read) return bad_input(fmt::format("{}: {}", file, read.error().message));
  return read;
}

}  // namespace cuticle::viz
