// Reads scenes/shadow_marks/*.json (study/README.md describes them).
#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include "core/file.h"
#include "core/json/json.h"
#include "shadows/clouds.h"
#include "shadows/footprint.h"
#include "strands/formats/formats.h"
#include "strands/growing/grow.h"
#include "strands/growing/specification.h"
#include "study/shadows/marks.h"
#include "study/shadows/slices_study.h"
// After the headers that include glm/matrix.hpp: the dialect defines Vec2 and Vec3.
#include "core/shared/philox.glslh"

namespace cuticle::study {
namespace {

/// A point spread evenly over the unit ball: the first of some in the cube that lies inside.
glm::vec3 in_ball(std::uint32_t guide, std::uint32_t follower, std::uint32_t seed) {
  for (std::uint32_t attempt = 0;; ++attempt) {
    const PhiloxBlock words = philox(PhiloxBlock{guide, follower, attempt, 0}, seed, 0x0f0110u);
    glm::vec3 point(0);
    unit_interval(words.a, point.x);
    unit_interval(words.b, point.y);
    unit_interval(words.c, point.z);
    point = 2.0f * point - 1.0f;
    if (point.x * point.x + point.y * point.y + point.z * point.z <= 1) return point;
  }
}

void append(strands::Groom& groom, std::span<const glm::vec3> points, float radius, const glm::vec3& move) {
  for (const glm::vec3& point : points) groom.positions.push_back(point + move);
  groom.radii.resize(groom.positions.size(), radius);
  groom.offsets.push_back(std::uint32_t(groom.positions.size()));
}

Result<strands::Groom> read_parts(const Json& json, const std::string& data) {
  const strands::ReadOptions options{json.at("metres_per_unit").number(), json.at("fibre_radius_m").number()};
  strands::Groom groom;
  for (const Json& part : json.at("parts")) {
    CUTICLE_ASSIGN(const auto file, strands::read_groom(data + "/" + part.text(), options));
    for (std::size_t s = 0; s < file.groom.strand_count(); ++s)
      append(groom, file.groom.strand(s), float(options.radius), glm::vec3(0));
  }
  return with_followers(groom, json.at("followers").get<int>(), json.at("follower_radius_m").number(),
                        json.at("seed").get<std::uint32_t>());
}

/// The first strands of what a specification grows.
Result<strands::Groom> grow_hair(const Json& json, const std::string& folder) {
  CUTICLE_ASSIGN(const auto specification, strands::load_specification(folder + "/" + json.at("specification").text()));
  CUTICLE_ASSIGN(const strands::Grown grown, strands::grow(specification));
  const std::size_t count = std::min(json.at("strands").get<std::size_t>(), grown.drawn.strand_count());
  strands::Groom groom;
  for (std::size_t s = 0; s < count; ++s)
    append(groom, grown.drawn.strand(s), json.at("fibre_radius_m").get<float>(), glm::vec3(0));
  return groom;
}

Result<strands::Groom> read_hair(const Json& json, const std::string& data, const std::string& folder) {
  if (json.contains("parts")) return read_parts(json, data);
  if (json.contains("specification")) return grow_hair(json, folder);
  const auto cloud = [&](const char* count) { return json.at(count).get<std::size_t>(); };
  const float radius = json.at("fibre_radius_m").get<float>();
  if (json.contains("smoke_points"))
    return shadows::smoke(cloud("smoke_points"), json.at("deviation_m").number(), radius);
  if (json.contains("leaves"))
    return shadows::foliage(cloud("leaves"), json.at("deviation_m").number(), json.at("leaf_length_m").number(),
                            radius);
  strands::Groom coat = study_coat(json.at("coat_strands").get<int>());
  std::fill(coat.radii.begin(), coat.radii.end(), radius);
  return coat;
}

/// `settings` maps a parameter to the texts that it takes in turn; every combination is a candidate.
/// Where no filter is given, lookups average the truth's footprint.
Result<void> add_settings(const shadows::Method& method, const Json& settings, const MarksFile& file,
                          std::vector<Candidate>& candidates) {
  const std::string filter = "filter_radius_mm";
  std::vector<std::string> sets = {""};
  for (const auto& [name, texts] : settings.items()) {
    std::vector<std::string> longer;
    for (const std::string& set : sets)
      for (const Json& text : texts)
        longer.push_back(fmt::format("{}{}{}={}", set, set.empty() ? "" : ",", name, text.text()));
    sets = std::move(longer);
  }
  for (const std::string& set : sets) {
    CUTICLE_ASSIGN(auto values, registry::parse_assignments(method.entry.parameters, set));
    if (!settings.contains(filter) && values.all().contains(filter)) values.set(filter, 1e3 * file.footprint_radius);
    candidates.push_back({&method, std::move(values)});
  }
  return {};
}

Result<Mark> read_mark(const Json& json, const MarksFile& file) {
  Mark mark{json.at("name").text(),
            json.at("method").text(),
            json.value("error", 0.0),
            json.value("bytes", std::size_t(0)),
            {}};
  CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(mark.method));
  for (const Json& settings : json.at("settings")) CUTICLE_TRY(add_settings(*method, settings, file, mark.candidates));
  return mark;
}

/// `groom`: where the name and the hair are; the rest is in `json`.
Result<MarksFile> marks_of(const Json& groom, const Json& json, const std::string& data, const std::string& folder) {
  MarksFile file;
  file.name = groom.at("name").text();
  CUTICLE_ASSIGN(file.groom, read_hair(groom.at("hair"), data, folder));
  file.alpha = json.at("alpha").number();
  file.footprint_radius = json.contains("footprint_radius_m") ? json.at("footprint_radius_m").number()
                                                              : shadows::default_footprint_radius(file.groom);
  file.rays = json.at("rays").get<int>();
  file.receivers = json.at("receivers").get<std::size_t>();
  for (const Json& light : json.at("lights"))
    file.lights.emplace_back(light.at(0).number(), light.at(1).number(), light.at(2).number());
  for (const Json& mark : json.at("marks")) {
    CUTICLE_ASSIGN(Mark read, read_mark(mark, file));
    file.marks.push_back(std::move(read));
  }
  if (file.lights.empty() || file.marks.empty()) return bad_input("'lights' and 'marks' must not be empty");
  return file;
}

Result<std::vector<MarksFile>> marks_from(const Json& json, const std::string& data, const std::string& folder) {
  std::vector<MarksFile> files;
  const Json grooms = json.contains("grooms") ? json.at("grooms") : Json::list({json});
  for (const Json& groom : grooms) {
    CUTICLE_ASSIGN(MarksFile file, marks_of(groom, json, data, folder));
    files.push_back(std::move(file));
  }
  return files;
}

}  // namespace

strands::Groom with_followers(const strands::Groom& guides, int count, double radius, std::uint32_t seed) {
  strands::Groom groom;
  for (std::uint32_t s = 0; s < guides.strand_count(); ++s) {
    const float fibre = guides.radii[guides.offsets[s]];
    append(groom, guides.strand(s), fibre, glm::vec3(0));
    for (int i = 0; i < count; ++i)
      append(groom, guides.strand(s), fibre, float(radius) * in_ball(s, std::uint32_t(i), seed));
  }
  return groom;
}

Result<std::vector<MarksFile>> read_marks(const std::string& path, const std::string& data) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  try {
    const Result<Json> json = Json::parse(text);
    const std::string folder = std::filesystem::path(path).parent_path().string();
    auto files = json ? marks_from(*json, data, folder) : Result<std::vector<MarksFile>>(json.error());
    if (!files) return Error{files.error().kind, path + ": " + files.error().message, files.error().hint};
    return files;
  } catch (const Json::Mismatch& error) {
    return bad_input(fmt::format("{}: {}", path, error.what()), "study/README.md");
  }
}

}  // namespace cuticle::study
