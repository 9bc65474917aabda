// What follows from errors and times: fronts, choices, exponents, rankings.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "study/engine/run.h"

namespace cuticle::study {
namespace {

/// The points of a group that are timed and have an error: by their error over some of the items, cost in units.
struct Field {
  std::vector<std::size_t> places;  ///< in the group
  std::vector<CostAndError> choosing, judging, all;
};

Field field_of(const GroupResult& group) {
  Field field;
  for (std::size_t i = 0; i < group.points.size(); ++i) {
    const PointResult& point = group.points[i];
    if (!point.time.is_timed() || point.metrics.empty() || point.metrics[0].all.items == 0) continue;
    const MetricResult& metric = point.metrics[0];
    const bool halved = metric.choosing.items > 1 && metric.judging.items > 1;
    field.places.push_back(i);
    field.all.push_back({point.time.units, metric.all.mean});
    field.choosing.push_back({point.time.units, (halved ? metric.choosing : metric.all).mean});
    field.judging.push_back({point.time.units, (halved ? metric.judging : metric.all).mean});
  }
  return field;
}

Json choice_json(const GroupResult& group, const Field& field, std::optional<std::size_t> chosen) {
  if (!chosen) return nullptr;
  const PointResult& point = group.points[field.places[*chosen]];
  return {{"point", point_name(point.method, point.knobs)},
          {"seconds", point.time.seconds.value},
          {"choosing_error", field.choosing[*chosen].error.value},
          {"judging_error", field.judging[*chosen].error.value},
          {"bytes", point.bytes}};
}

Json front_json(const GroupResult& group, const Field& field) {
  const std::vector<FrontPlace> places = pareto_front(field.all);
  Json json = Json::list();
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (places[i].surely_beaten) continue;
    const PointResult& point = group.points[field.places[i]];
    json.push_back({{"point", point_name(point.method, point.knobs)}, {"on_front", places[i].on_front}});
  }
  return json;
}

/// Decades of the group's errors, or of its seconds, that lie within its points.
std::vector<double> steps(const std::vector<double>& values) {
  double low = 1e300, high = 0;
  for (double value : values)
    if (value > 0) low = std::min(low, value), high = std::max(high, value);
  std::vector<double> result;
  if (high == 0) return result;
  for (int decade = int(std::floor(std::log10(low))); decade <= int(std::ceil(std::log10(high))); ++decade)
    for (double factor : {1.0, 3.0})
      if (const double value = factor * std::pow(10.0, decade); value >= low && value <= 3 * high && result.size() < 12)
        result.push_back(value);
  return result;
}

Json choices_json(const Group& declared, const GroupResult& group, const Field& field) {
  std::vector<double> errors, seconds;
  for (std::size_t i = 0; i < field.places.size(); ++i) {
    errors.push_back(field.choosing[i].error.value);
    seconds.push_back(group.points[field.places[i]].time.seconds.value);
  }
  Json cheapest = Json::list(), accurate = Json::list();
  for (double most : steps(errors))
    if (most >= declared.floor)
      cheapest.push_back({{"error_at_most", most}, {"choice", choice_json(group, field, cheapest_for(field.choosing, most))}});
  std::vector<CostAndError> by_seconds = field.choosing;
  for (std::size_t i = 0; i < by_seconds.size(); ++i) by_seconds[i].cost.value = seconds[i];
  for (double most : steps(seconds))
    accurate.push_back(
        {{"seconds_at_most", most}, {"choice", choice_json(group, field, most_accurate_within(by_seconds, most))}});
  return {{"cheapest_for", cheapest}, {"most_accurate_within", accurate}};
}

/// Of a group without errors: seconds against the methods' one knob, where it is a number.
Json growth_json(const GroupResult& group) {
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> methods;
  for (const PointResult& point : group.points) {
    if (!point.time.is_timed() || point.knobs.size() != 1) continue;
    auto& [size, seconds] = methods[point.method];
    size.push_back(std::strtod(point.knobs[0].value.c_str(), nullptr));
    seconds.push_back(point.time.seconds.value);
  }
  Json json = Json::list();
  for (const auto& [method, values] : methods)
    if (const auto exponent = scaling_exponent(values.first, values.second))
      json.push_back({{"method", method}, {"exponent", exponent->value}, {"standard_error", exponent->standard_error}});
  return json;
}

/// Error against seconds of each method with three settings or more.
Json exponents_json(const GroupResult& group, const Field& field) {
  std::map<std::string, std::pair<std::vector<double>, std::vector<double>>> methods;
  for (std::size_t i = 0; i < field.places.size(); ++i) {
    auto& [cost, error] = methods[group.points[field.places[i]].method];
    cost.push_back(field.all[i].cost.value);
    error.push_back(field.all[i].error.value);
  }
  Json json = Json::list();
  for (const auto& [method, values] : methods)
    if (const auto exponent = scaling_exponent(values.first, values.second))
      json.push_back({{"method", method}, {"exponent", exponent->value}, {"standard_error", exponent->standard_error}});
  return json;
}


bool are_apart(const Interval& a, const Interval& b) { return is_below(a, b) || is_below(b, a); }

/// Pairs of points that no other surely beats: which are ranked for certain, in time and in error, by their names.
Json rankings_json(const GroupResult& group, const Field& field) {
  const std::vector<FrontPlace> places = pareto_front(field.all);
  Json faster = Json::list(), exact = Json::list();
  int undecided_time = 0, undecided_error = 0;
  const auto pair = [&](std::size_t a, std::size_t b) {
    const PointResult &first = group.points[field.places[a]], &second = group.points[field.places[b]];
    return Json::list({point_name(first.method, first.knobs), point_name(second.method, second.knobs)});
  };
  for (std::size_t a = 0; a < places.size(); ++a)
    for (std::size_t b = 0; b < places.size(); ++b) {
      if (a == b || places[a].surely_beaten || places[b].surely_beaten) continue;
      if (is_below(field.all[a].cost, field.all[b].cost)) faster.push_back(pair(a, b));
      if (is_below(field.all[a].error, field.all[b].error)) exact.push_back(pair(a, b));
      undecided_time += a < b && !are_apart(field.all[a].cost, field.all[b].cost);
      undecided_error += a < b && !are_apart(field.all[a].error, field.all[b].error);
    }
  return {{"faster", faster},
          {"more_exact", exact},
          {"pairs_not_ranked_in_time", undecided_time},
          {"pairs_not_ranked_in_error", undecided_error}};
}

}  // namespace

Json conclusions_json(const Study& study, const StudyResult& result) {
  Json json = Json::list();
  for (std::size_t g = 0; g < study.groups.size(); ++g) {
    const GroupResult& group = result.groups[g];
    const Field field = field_of(group);
    Json one{{"group", study.groups[g].name},
             {"front", front_json(group, field)},
             {"knee", choice_json(group, field, knee(field.all))}};
    one.update(choices_json(study.groups[g], group, field));
    one["exponents"] = exponents_json(group, field);
    one["growth"] = study.groups[g].metrics.empty() ? growth_json(group) : Json::list();
    one["rankings"] = rankings_json(group, field);
    json.push_back(std::move(one));
  }
  return {{"name", study.name}, {"groups", json}};
}

}  // namespace cuticle::study
