#include "study/engine/compare.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include <fmt/core.h>

#include "core/file.h"

namespace cuticle::study {
namespace {

namespace fs = std::filesystem;

struct Side {
  Interval error, time;
  bool is_timed = false;
};
using Sides = std::map<std::vector<std::string>, Side>;  ///< study, group, point

Interval interval_of(const Json& json) {
  const Json& high = json.at("high");
  return {json.at("value").number(), json.at("low").number(),
          high.is_null() ? std::numeric_limits<double>::infinity() : high.number()};
}

Result<Json> read_json(const std::string& path) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  auto json = Json::parse(text);
  if (!json) return bad_input(fmt::format("{}: {}", path, json.error().message));
  return json;
}

void add_errors(Sides& sides, const Json& result) {
  for (const Json& group : result.at("groups"))
    for (const Json& point : group.at("points"))
      if (!point.at("errors").empty())
        sides[{result.at("name").text(), group.at("name").text(), point.at("point").text()}].error =
            interval_of(point.at("errors").at(std::size_t(0)).at("mean"));
}

void add_times(Sides& sides, const Json& times) {
  for (const Json& group : times.at("groups"))
    for (const Json& point : group.at("points")) {
      Side& side = sides[{times.at("name").text(), group.at("name").text(), point.at("point").text()}];
      side.time = interval_of(point.at("kernels"));
      side.is_timed = true;
    }
}

Result<Json> add_folder(Sides& sides, const std::string& folder) {
  CUTICLE_ASSIGN(const Json result, read_json(folder + "/result.json"));
  CUTICLE_ASSIGN(const Json times, read_json(folder + "/times.json"));
  try {
    add_errors(sides, result);
    add_times(sides, times);
    return times.at("machine");
  } catch (const Json::Mismatch& mismatch) {
    return bad_input(fmt::format("{}: result.json or times.json: {}", folder, mismatch.what()));
  }
}

/// The folder itself, or those below it.
std::vector<std::string> folders_of(const std::string& folder) {
  if (fs::exists(folder + "/result.json")) return {folder};
  std::vector<std::string> found;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (fs::exists(entry.path() / "result.json")) found.push_back(entry.path().string());
  std::ranges::sort(found);
  return found;
}

Result<std::pair<Sides, Json>> read_side(const std::string& folder) {
  std::pair<Sides, Json> side;
  const std::vector<std::string> folders = folders_of(folder);
  if (folders.empty())
    return bad_input(fmt::format("{}: holds no result.json, nor does a folder in it", folder), "cuticle study all --out DIR");
  for (const std::string& each : folders) {
    CUTICLE_ASSIGN(side.second, add_folder(side.first, each));
  }
  return side;
}

std::string line(const ComparedPoint& point) {
  const bool is_time = point.slower() || point.faster();
  const Interval &a = is_time ? point.time_a : point.error_a, &b = is_time ? point.time_b : point.error_b;
  return fmt::format("  {}, {}, {}: {} {:.4g} ({:.4g} .. {:.4g}) -> {:.4g} ({:.4g} .. {:.4g})\n", point.study, point.group,
                     point.point, is_time ? "time" : "error", a.value, a.low, a.high, b.value, b.low, b.high);
}

template <class Is>
std::string part(const StudyComparison& comparison, std::string_view title, const Is& is) {
  std::string lines;
  int count = 0;
  for (const ComparedPoint& point : comparison.points)
    if (is(point)) {
      lines += line(point);
      ++count;
    }
  return fmt::format("{}: {}\n{}", title, count, lines);
}

std::string machine_text(const Json& machine) {
  return fmt::format("{}, {} threads, {}, commit {}", machine.at("processor").text(), machine.at("threads").whole(),
                     machine.at("build").text(), machine.at("commit").text());
}

}  // namespace

Result<StudyComparison> compare_studies(const std::string& a, const std::string& b) {
  CUTICLE_ASSIGN(const auto side_a, read_side(a));
  CUTICLE_ASSIGN(const auto side_b, read_side(b));
  StudyComparison comparison{side_a.second, side_b.second, {}, {}, {}};
  const auto name = [](const auto& key) { return fmt::format("{}, {}, {}", key[0], key[1], key[2]); };
  for (const auto& [key, one] : side_a.first) {
    const auto other = side_b.first.find(key);
    if (other == side_b.first.end()) {
      comparison.only_a.push_back(name(key));
      continue;
    }
    comparison.points.push_back({key[0], key[1], key[2], one.error, other->second.error, one.time, other->second.time,
                                 one.is_timed && other->second.is_timed});
  }
  for (const auto& [key, one] : side_b.first)
    if (!side_a.first.contains(key)) comparison.only_b.push_back(name(key));
  return comparison;
}

bool has_regressions(const StudyComparison& comparison) {
  return std::ranges::any_of(comparison.points,
                             [](const ComparedPoint& point) { return point.slower() || point.less_exact(); });
}

std::string to_text(const StudyComparison& comparison) {
  std::string text = fmt::format("A: {}\nB: {}\n", machine_text(comparison.machine_a), machine_text(comparison.machine_b));
  text += part(comparison, "slower in B", [](const ComparedPoint& p) { return p.slower(); });
  text += part(comparison, "less exact in B", [](const ComparedPoint& p) { return p.less_exact(); });
  text += part(comparison, "faster in B", [](const ComparedPoint& p) { return p.faster(); });
  text += part(comparison, "more exact in B", [](const ComparedPoint& p) { return p.more_exact(); });
  text += fmt::format("{} points compared; {} only in A, {} only in B. Times are in runs of the kernel; what is not named "
                      "is not told apart.\n",
                      comparison.points.size(), comparison.only_a.size(), comparison.only_b.size());
  return text;
}

Json to_json(const StudyComparison& comparison) {
  const auto interval = [](const Interval& i) { return Json::list({i.value, i.low, i.high}); };
  Json points = Json::list();
  for (const ComparedPoint& point : comparison.points)
    points.push_back({{"study", point.study},
                      {"group", point.group},
                      {"point", point.point},
                      {"error", Json::list({interval(point.error_a), interval(point.error_b)})},
                      {"kernels", Json::list({interval(point.time_a), interval(point.time_b)})},
                      {"slower", point.slower()},
                      {"faster", point.faster()},
                      {"less_exact", point.less_exact()},
                      {"more_exact", point.more_exact()}});
  return {{"machines", Json::list({comparison.machine_a, comparison.machine_b})},
          {"points", points},
          {"only_a", comparison.only_a},
          {"only_b", comparison.only_b}};
}

}  // namespace cuticle::study
