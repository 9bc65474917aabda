#pragma once
// Marks of error that shadow methods are held to, on a groom and lights fixed in a file (scenes/shadow_marks/*.json).
#include <string>
#include <string_view>
#include <vector>

#include "study/shadows/comparison.h"

namespace cuticle::study {

/// The most error that the best of some settings may have within a number of bytes.
struct Mark {
  std::string name, method;
  double error = 0;       ///< mean |error| of T, mean of the lights; 0: only measured
  std::size_t bytes = 0;  ///< 0: any
  std::vector<Candidate> candidates;
};
/// What a file of marks fixes for one of its grooms; lengths in metres.
struct MarksFile {
  std::string name;
  strands::Groom groom;
  double alpha = 0.4, footprint_radius = 0;
  std::vector<glm::dvec3> lights;
  int rays = 1024;
  std::size_t receivers = 3000;
  std::vector<Mark> marks;
};

/// Each strand with `count` followers beside it: copies moved by vectors spread evenly over a ball of `radius` metres.
strands::Groom with_followers(const strands::Groom& guides, int count, double radius, std::uint32_t seed);

/// Reads the file of marks and its grooms, whose parts lie below `data`. Error: bad_input, naming the file and the key.
Result<std::vector<MarksFile>> read_marks(const std::string& path, const std::string& data);

/// A mark beside its best setting within the bytes, chosen on one half of the receivers and reported on the other.
struct MarkResult {
  const Mark* mark = nullptr;
  std::string settings;                      ///< empty: none keeps the bytes
  double error = 0, interval = 0, bias = 0;  ///< mean of the lights; interval: half width that holds 95 %
  std::size_t bytes = 0;
  bool met() const { return !settings.empty() && (mark->error == 0 || error <= mark->error); }
};
struct MarksReport {
  std::vector<Comparison> lights;   ///< one per light, rows in the same order
  std::vector<MarkResult> results;  ///< one per mark
};
/// Error: what compare_with_truth and the methods refuse.
Result<MarksReport> measure_marks(const MarksFile& file, Progress& progress);

/// Groom, lights, baselines and one line per mark, as text and as JSON.
std::string to_text(const MarksFile& file, const MarksReport& report);
std::string to_json(const MarksFile& file, const MarksReport& report);

}  // namespace cuticle::study
