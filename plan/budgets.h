#pragma once
// Methods and settings that keep a scene's budgets, by the study's table of errors and the device's table of times.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plan/cost_table.h"

namespace cuticle::plan {

/// How far off one setting of one part of a frame was on the study's grooms. `part`: "shadow", "coverage", "shading" or
/// "motion". `settings`: as --set takes them, over the defaults.
struct AccuracyRow {
  std::string part, method, settings;
  double error = 0;    ///< mean over the grooms
  double at_most = 0;  ///< of a groom that was not measured, with 95 %
  int grooms = 0;
};
struct AccuracyTable {
  std::string made;  ///< by which command, of which grooms
  std::vector<AccuracyRow> rows;
};

Result<AccuracyTable> read_accuracy_table(const std::string& path);
Result<void> write_accuracy_table(const std::string& path, const AccuracyTable& table);

/// The scene with the row's setting. Error: usage, where it is none of this build.
Result<scene::Scene> with_setting(const scene::Scene& scene, const AccuracyRow& row);
/// What the times of a row's pass are stored under: "deep_opacity layers=8"; with default settings the pass's name.
std::string cost_name(const AccuracyRow& row);

/// Device memory of a scene, bytes: as it is, and by how much each row's setting changes it.
struct MemoryTable {
  double of_scene = 0;
  std::map<std::string, double, std::less<>> change;  ///< by memory_name
};
/// "shadow deep_opacity layers=8": what a row's memory is stored under.
std::string memory_name(const AccuracyRow& row);
/// The rows that the search for a scene's budgets may put together.
std::vector<AccuracyRow> rows_in_question(const scene::Scene& scene, const registry::FrameShape& shape,
                                          const DeviceTraits& device, const AccuracyTable& accuracy);

struct BudgetChoice {
  scene::Scene scene;                 ///< with the settings chosen; as given where it refuses
  std::vector<AccuracyRow> rows;      ///< chosen, one for each part that the scene has
  std::optional<double> expected_ms;  ///< of a frame; none: some pass has no time
  double at_most_ms = 0;              ///< with 95 %: CostTable::most_over_expected
  double expected_bytes = 0;          ///< of the device; 0: no budget for it
  std::string refused;                ///< why no settings do; empty: these do
};
/// Of all settings that keep the errors wanted the quickest; where only a time or memory is wanted, those with the
/// least errors that keep it. Refuses where none does, and says what comes nearest. `shape` of the scene as it is;
/// `memory` where the scene has a budget for it.
BudgetChoice choose(const scene::Scene& scene, const registry::FrameShape& shape, const DeviceTraits& device,
                    const AccuracyTable& accuracy, const CostTable& costs, const MemoryTable& memory = {});

/// The choice in words: settings, errors and time expected.
std::string to_text(const BudgetChoice& choice, const scene::Budgets& wanted);

}  // namespace cuticle::plan
