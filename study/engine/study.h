#pragma once
// What a study is: groups of methods that answer the same question, each measured against the group's truth on the same
// items, and timed. The engine measures, times, draws conclusions and writes; a study only declares.
#include <algorithm>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/progress.h"
#include "core/result.h"

namespace cuticle::study {

/// How the errors of the items become one number: the mean of their magnitudes; its root of the mean square; of items
/// that estimate squares without bias, so that noise may make some of them negative, the mean as it is, or its root.
enum class Mean { arithmetic, root_mean_square, squares, root_of_squares };
/// An error: file-like name ("S"), what it is ("relative error of S"), its unit ("1", "m") and mean. Less is better.
struct Metric {
  std::string name, label = {}, unit = "1";
  Mean mean = Mean::arithmetic;
};

/// A setting of a method, as `--set` takes it.
struct Knob {
  std::string name, value;
};

/// What one point gave: errors [metric][item], one list for each metric of its group; NaN: not defined at the item.
struct Measured {
  std::vector<std::vector<double>> errors = {};
  double bytes = 0;  ///< of the memory that the point's data take
};
/// What is timed. `before`, if set, makes ready and is not timed. One call of `run` is `evaluations` evaluations.
struct Work {
  std::function<Result<void>()> before = {}, run = {};
  double evaluations = 1;
};

/// How long timing may take.
struct TimingRequest {
  int rounds = 9;                ///< samples of a point, at most
  double sample_seconds = 2e-3;  ///< a sample calls the work so often that it lasts about so long, once at least
  double point_seconds = 1;      ///< a point whose samples together take longer has fewer of them, three at least
  double slow_seconds = 5;       ///< of one call, from which on a point has one sample alone, and no interval

  /// Of a study's quick form: fewer samples, so that intervals are wider.
  TimingRequest quick() const {
    return {std::min(rounds, 5), sample_seconds, std::min(point_seconds, 0.2), std::min(slow_seconds, 0.5)};
  }
};

/// One setting of one method. `work.run` not set: not timed.
struct Point {
  std::string method = {};
  std::vector<Knob> knobs = {};
  std::function<Result<Measured>()> measure = {};
  Work work = {};
  double seconds = 0;  ///< of a point whose work is not set: its time, taken once; 0: none
};

/// Methods that answer one question on the same items. The first metric is the one that points are ranked by.
struct Group {
  std::string name, title, truth = {};  ///< `truth` says in words what errors are against
  std::vector<Metric> metrics = {};
  std::string item = "item";  ///< what the errors are means over ("direction", "receiver")
  double floor =
      0;  ///< how well the truth is known: errors below it mean nothing, one of a single item is known to within it
  std::vector<Point> points = {};
};

/// Curves beside the points, of one plot; a polar one has degrees as x.
struct Curve {
  std::string name;
  std::vector<double> x = {}, y = {};
  bool marks = false;  ///< drawn as marks instead of a line: what was measured beside what is expected
};
struct Plot {
  std::string name, title = {}, x_label = {}, y_label = {};
  bool polar = false, logarithmic = false;  ///< logarithmic: both axes
  std::vector<Curve> curves = {};
  bool logarithmic_x = false, logarithmic_y = false;  ///< one axis alone
};
/// A function of two coordinates: values [y][x].
struct Grid {
  std::string name, title = {}, x_label = {}, y_label = {}, z_label = {};
  std::vector<double> x = {}, y = {};
  std::vector<std::vector<double>> values = {};
};
/// A table beside the points, and a picture with what it shows; `beside` names the picture it is compared with.
struct Table {
  std::string name, title;
  std::vector<std::string> columns = {};
  std::vector<std::vector<std::string>> rows = {};
};
struct StudyPicture {
  std::string file, title, beside;
  Image image = {};  ///< display values, 0 .. 1
};

struct Study {
  std::string name, title = {}, question = {};
  std::string cost_label = "time";  ///< of one evaluation ("S of one direction"); the unit is chosen by the reporter
  bool wall_clock = false;          ///< work waits for a device: wall clock; else processor time of the process
  std::string device = {}, driver = {};  ///< empty: none was used
  TimingRequest timing = {};
  std::vector<Group> groups = {};
  std::vector<Plot> plots = {};
  std::vector<Grid> grids = {};
  std::vector<Table> tables = {};
  std::vector<StudyPicture> pictures = {};
  std::vector<std::string> notes = {};
};

/// An option of a study beside --quick, as text; one may be typed without its name.
struct StudyOption {
  std::string name, value = {}, help = {};
  bool positional = false;
};
struct StudyRequest {
  bool quick = false;
  std::map<std::string, std::string> options = {};  ///< every one of the entry's
  std::string device = {};                          ///< as --device
  std::string share = {};                           ///< folder of the files that travel with the program (scenes)
};

/// A registered study. `declare` makes it; what it computes itself (truths, curves) is deterministic.
struct StudyEntry {
  std::string name, summary = {};
  std::vector<StudyOption> options = {};
  Result<Study> (*declare)(const StudyRequest& request, Progress& progress) = nullptr;
  double quick_seconds = 5, seconds = 60;  ///< measured, two cores; for the remaining time of `study all`
};

/// The entry by name. Error: usage, with the nearest name.
Result<const StudyEntry*> find_study(std::span<const StudyEntry* const> entries, std::string_view name);

}  // namespace cuticle::study
