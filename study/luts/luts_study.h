#pragma once
// What lookup tables lose and cost beside the model that they stand for: layout x size x format x fit.
#include <span>
#include <string>
#include <vector>

#include "core/progress.h"
#include "lut/table_set.h"

namespace cuticle::study {

struct LutsRequest {
  std::vector<std::string> models = {"marschner"};
  std::string settings;              ///< of every model, as --set takes them
  std::vector<std::string> layouts;  ///< empty: all whose tables make S
  std::vector<int> sizes = {16, 32, 64, 128, 256};
  std::vector<std::string> formats = {"exr", "png16", "png8"};
  std::vector<std::string> fits = {"none", "texels"};
  int largest_fitted = 128;   ///< texels each way up to which fits are made
  std::size_t points = 4096;  ///< random directions that are timed
  int repeats = 20;           ///< timings, of which the best counts
};

/// One channel of a set, or S, which is put together from all: errors as lut::certify measures them, rms over that of
/// the signal, the rest over the peak. `ns` is the time of one S from the set's tables, one thread, in float.
struct LutRow {
  std::string model, layout, format, fit, channel;
  int size = 0;
  double rms_error = 0, p99_error = 0, max_error = 0;
  std::size_t bytes = 0;  ///< of the set's texels in the format
  double ns = 0, bake_ms = 0;
};

/// S of the model itself, sum of its lobes, or of one lobe: one thread.
struct DirectRow {
  std::string model, path, lobe;  ///< "double", "float" or "float, batch"; "S" or a lobe
  double ns = 0, rms_error = 0;   ///< against double
};

struct LutsStudy {
  std::vector<LutRow> rows;
  std::vector<DirectRow> direct;
  std::vector<std::string> verdicts;  ///< sentences made from the rows
  std::vector<std::string> skipped;   ///< what could not be baked, with the reason
};

/// Errors: usage for an unknown name; what baking, fitting and certifying say but for a layout that does not fit a
/// model, which is noted in `skipped`.
Result<LutsStudy> run_luts_study(const LutsRequest& request, Progress& progress);

/// The time and error of the model's own evaluation.
Result<std::vector<DirectRow>> measure_direct(const bsdf::Model& model, const registry::ParameterValues& values,
                                              std::size_t points, int repeats);
/// Time of one S from the tables, in nanoseconds, the best of the repeats.
Result<double> sampling_ns(const lut::TableSet& set, std::size_t points, int repeats);
/// For each model: whether a table or the model itself is cheaper at each error.
std::vector<std::string> verdicts_of(const LutsStudy& study);

std::string to_json(const LutsStudy& study);
std::string to_csv(const LutsStudy& study);
/// Writes study.json and study.csv (study/README.md) into a folder, which is made.
Result<void> write_luts_study(const LutsStudy& study, const std::string& folder);

}  // namespace cuticle::study
