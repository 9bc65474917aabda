// What accuracy costs in time: the registered studies.
#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>

#include "study/engine/run.h"
#include "study/registry/entries.h"

#include "python/arrays.h"
#include "python/interruptible.h"
#include "python/signals.h"

namespace cuticle::python {
namespace {

Json json_of(const study::StudyEntry& entry) {
  Json options = Json::list();
  for (const study::StudyOption& option : entry.options)
    options.push_back({{"name", option.name}, {"default", option.value}, {"help", option.help}});
  return {{"name", entry.name},
          {"summary", entry.summary},
          {"options", options},
          {"seconds", entry.seconds},
          {"quick_seconds", entry.quick_seconds}};
}

std::string studies() {
  Json all = Json::list();
  for (const study::StudyEntry* entry : study::studies()) all.push_back(json_of(*entry));
  return all.dump();
}

Result<std::string> run(const study::StudyEntry& entry, const study::StudyRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const study::Study declared, study::declare(entry, request, progress));
  CUTICLE_ASSIGN(const study::StudyResult result, study::run_study(declared, progress));
  return Json{{"result", study::result_json(declared, result, "")},
              {"times", study::times_json(declared, result)},
              {"conclusions", study::conclusions_json(declared, result)}}
      .dump();
}

/// result, times and conclusions as the files of `cuticle study` hold them.
std::string run_study(const std::string& name, bool quick, const std::map<std::string, std::string>& options,
                      const std::string& device, const std::string& share, const nb::object& call) {
  const study::StudyEntry* entry = value_or_raise(study::find_study(study::studies(), name));
  study::StudyRequest request{quick, {}, device, share};
  for (const study::StudyOption& option : entry->options) request.options[option.name] = option.value;
  for (const auto& [option, value] : options) {
    if (!request.options.contains(option)) raise(usage_error("study '" + name + "' has no option '" + option + "'"));
    request.options[option] = value;
  }
  CalledProgress progress(call);
  return value_or_raise(interruptible([&] { return run(*entry, request, progress); }));
}

}  // namespace

void add_studies(nb::module_& module) {
  module.def("studies", &studies);
  module.def("run_study", &run_study, nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg(), nb::arg().none());
}

}  // namespace cuticle::python
