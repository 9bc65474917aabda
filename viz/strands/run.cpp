// Finding and reading the states of a run.
#include <algorithm>
#include <charconv>
#include <filesystem>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "core/file.h"
#include "strands/formats/formats.h"
#include "viz/strands/states.h"

namespace cuticle::viz {
namespace {

namespace fs = std::filesystem;

Result<Run> read_series(const fs::path& file) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(file.string()));
  pugi::xml_document document;
  const auto parsed = document.load_buffer(text.data(), text.size());
  const pugi::xml_node collection = document.child("VTKFile").child("Collection");
  if (!parsed || !collection)
    return bad_input(fmt::format("{}: not a series of states (VTK XML collection)", file.string()),
                     "states.pvd of cuticle simulate");
  Run run{file.parent_path().filename().string(), {}};
  CUTICLE_ASSIGN(run.colliders, read_colliders(file.parent_path().string()));
  for (const pugi::xml_node& set : collection.children("DataSet"))
    run.frames.push_back(
        {set.attribute("timestep").as_double(), (file.parent_path() / set.attribute("file").as_string()).string()});
  if (run.frames.empty()) return bad_input(fmt::format("{}: the series has no states", file.string()));
  return run;
}

/// The number at the end of a file's stem, "state_0060.vtp": 60; -1: none.
int number_of(const std::string& file) {
  const std::string stem = fs::path(file).stem().string();
  std::size_t begin = stem.size();
  while (begin > 0 && std::isdigit(static_cast<unsigned char>(stem[begin - 1]))) --begin;
  int number = -1;
  std::from_chars(stem.data() + begin, stem.data() + stem.size(), number);
  return number;
}

}  // namespace

Result<Run> find_run(const std::string& path) {
  const fs::path place(path);
  if (fs::is_directory(place)) {
    CUTICLE_ASSIGN(Run run, read_series(place / "states.pvd"));
    run.name = fs::absolute(place).lexically_normal().filename().string();
    if (run.name.empty()) run.name = fs::absolute(place).lexically_normal().parent_path().filename().string();
    return run;
  }
  if (place.extension() == ".pvd") return read_series(place);
  Run run{place.filename().string(), {{0, path}}};
  CUTICLE_ASSIGN(run.colliders, read_colliders(place.parent_path().empty() ? "." : place.parent_path().string()));
  return run;
}

std::vector<sim::PlacedCollider> Run::colliders_at(int frame) const {
  return colliders.at(number_of(frames[std::size_t(frame)].file));
}

glm::dmat4 Run::head_at(int frame) const {
  const auto found = colliders.heads.find(number_of(frames[std::size_t(frame)].file));
  return found == colliders.heads.end() ? glm::dmat4(1) : found->second;
}

Result<int> frame_at(const Run& run, int number) {
  for (int place = 0; place < int(run.frames.size()); ++place)
    if (number_of(run.frames[std::size_t(place)].file) == number) return place;
  return usage_error(fmt::format("--frame {}: {} has {} states, {} .. {}", number, run.name, run.frames.size(),
                                 number_of(run.frames.front().file), number_of(run.frames.back().file)),
                     "one of these");
}

Result<strands::Groom> read_frame(const Run& run, int frame, double metres_per_unit) {
  const std::string& file = run.frames[std::size_t(frame)].file;
  const double unit = metres_per_unit == 0 && file.ends_with(".vtp") ? 1 : metres_per_unit;
  CUTICLE_ASSIGN(strands::GroomFile read, strands::read_groom(file, {.metres_per_unit = unit}));
  return std::move(read.groom);
}

}  // namespace cuticle::viz
