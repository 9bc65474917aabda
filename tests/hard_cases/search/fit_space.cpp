// Fits of a model's parameter to data that it may not be able to make: the answer lies in the parameter's range.
#include "bsdf/model.h"
#include "tests/hard_cases/search/coordinates.h"

namespace cuticle::hard_cases::search {
namespace {

const registry::Parameter& parameter_of(const char* name) {
  return **registry::find_parameter((*bsdf::find_model("marschner"))->entry.parameters, name);
}

std::string setting(const registry::Parameter& parameter, Coordinates& at) {
  const registry::Parameter alone[] = {parameter};
  return at.settings(alone);
}

Json fit_case(const char* name, const Place& place) {
  Coordinates at(place);
  const registry::Parameter& parameter = parameter_of(name);
  Json inputs{{"model", "marschner"}, {"free", Json::list({name})}, {"quantity", "S"}};
  inputs["truth"] = setting(parameter, at);
  inputs["start"] = setting(parameter, at);
  inputs["scale"] = 1 + at.around_zero(1e6);
  inputs["add"] = at.around_zero(1e3);
  inputs["theta_i_deg"] = Json::list({at.between(-90, 90), 20});
  inputs["theta_o_deg"] = Json::list({at.between(-90, 90), -10});
  inputs["phi_deg"] = Json::list({at.between(-180, 180), 0, 60, 150});
  return Json{{"subject", "fit"},
              {"inputs", std::move(inputs)},
              {"expect", Json{{"bounds", Json::list({parameter.minimum, parameter.maximum})}}}};
}

}  // namespace

std::vector<Space> fit_spaces() {
  std::vector<Space> all;
  for (const char* name : {"eta", "sigma_a", "beta"})
    all.push_back({.name = std::string("fit_") + name,
                   .size = 7,
                   .case_at = [name](const Place& place) { return fit_case(name, place); },
                   .climbs = 1});
  return all;
}

}  // namespace cuticle::hard_cases::search
