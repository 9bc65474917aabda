#pragma once
// Whether a folder of tables still says what its manifest says, and what went wrong on the way if it does not.
#include <string>
#include <vector>

#include "core/image/image.h"
#include "lut/manifest.h"

namespace cuticle::lut::check {

/// A mistake of import or export, with its name, what is seen, and what to do.
struct Mistake {
  std::string name;      ///< "sRGB decoded"
  std::string evidence;  ///< a sentence
  std::string remedy;    ///< a sentence
};
struct TableVerdict {
  std::string table, file;
  bool unchanged = false;  ///< the file is the one that bake wrote, byte for byte
  bool passed = false;
  double misfit = 0;  ///< largest distance of a probe, in tolerances: up to 1 passes
  std::string worst;  ///< the probe and channel of that distance
  Mistake mistake;    ///< of a table that failed; "unknown" when no cause explains the readings
};
struct Report {
  std::string folder, model, layout, format;
  std::vector<TableVerdict> tables;
  bool passed() const;
};

/// Reads every table of a folder by its manifest and compares the probes. A table that fails is compared again after
/// undoing each known mistake; the one that explains the readings best is named. Ten damages of each kind are named in
/// lut_check_test. Error: bad_input for a manifest or a file that cannot be read, naming key or field.
Result<Report> check_folder(const std::string& folder);
/// The verdict on one table's stored numbers.
TableVerdict check_table(const ManifestTable& table, const Image& image);
/// The report as JSON text.
std::string to_json(const Report& report);

}  // namespace cuticle::lut::check
