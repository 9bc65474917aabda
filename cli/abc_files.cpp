#include "cli/abc_files.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/core.h>

#include "cli/shared_files.h"
#include "core/output_file.h"

namespace cuticle::cli {

namespace {

namespace fs = std::filesystem;

/// What python/cuticle_abc ends with.
enum AbcExit { done = 0, no_alembic3d = 4 };

using Lines = std::vector<std::string>;

/// Runs cuticle_abc; what it said, a sentence a line. `said`: a file that is not there, in a folder of our own.
Result<Lines> ask_alembic(const std::vector<std::string>& arguments, const std::string& said,
                          const std::string& named) {
  const int code = run_python("cuticle_abc", arguments);
  std::ifstream file(said);
  const bool it_ran = file.good();
  Lines lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  if (code == done) return lines;
  if (code == no_alembic3d || !it_ran)
    return bad_input(fmt::format("{}: needs Python with alembic3d", named),
                     "pip install alembic3d, or convert to .usda elsewhere");
  return bad_input(fmt::format("{}: Alembic cannot read or write it{}", named, lines.empty() ? "" : ": " + lines[0]));
}

Result<Temporary> own_folder() {
  CUTICLE_ASSIGN(const std::string parent, temporary_folder());
  return Temporary::folder(parent);
}

/// The unit that a file states, metres; 0: none.
double unit_in(const Lines& said) {
  double unit = 0;
  if (!said.empty()) std::from_chars(said[0].data(), said[0].data() + said[0].size(), unit);
  return unit > 0 && unit < 1e6 ? unit : 0;
}

/// An error of the arrays between, said of the file itself.
Error named_after(const std::string& path, const std::string& arrays, Error error) {
  if (const std::size_t at = error.message.find(arrays); at != std::string::npos)
    error.message.replace(at, arrays.size(), path);
  return error;
}

}  // namespace

bool is_abc(const std::string& path) { return fs::path(path).extension() == ".abc"; }

Result<strands::GroomFile> read_abc(const std::string& path, const strands::ReadOptions& options) {
  CUTICLE_ASSIGN(const Temporary folder, own_folder());
  const std::string arrays = folder.path() + "/groom.npz", said = folder.path() + "/said";
  CUTICLE_ASSIGN(const Lines lines, ask_alembic({"read", fs::absolute(path).string(), arrays, said}, said, path));
  strands::ReadOptions asked = options;
  if (const double unit = unit_in(lines); unit > 0 && asked.metres_per_unit == 0) asked.metres_per_unit = unit;
  auto file = strands::read_groom(arrays, asked);
  if (!file) return named_after(path, arrays, file.error());
  for (std::size_t k = 1; k < lines.size(); ++k) file->notes.push_back(lines[k]);
  return file;
}

Result<void> write_abc(const std::string& path, const strands::Groom& groom, double metres_per_unit) {
  if (!std::isfinite(metres_per_unit) || metres_per_unit <= 0)
    return usage_error(fmt::format("metres per unit {}, must be above 0", metres_per_unit));
  CUTICLE_ASSIGN(const Temporary folder, own_folder());
  const std::string arrays = folder.path() + "/groom.npz", said = folder.path() + "/said";
  CUTICLE_TRY(strands::write_groom(arrays, groom));
  return write_through_temporary(path, [&](const std::string& name) -> Result<void> {
    CUTICLE_TRY(ask_alembic({"write", arrays, fs::absolute(name).string(), said, fmt::format("{}", metres_per_unit),
                             "Cuticle " CUTICLE_VERSION},
                            said, path));
    return {};
  });
}

Result<AbcSchema> check_abc(const std::string& path) {
  CUTICLE_ASSIGN(const Temporary folder, own_folder());
  const std::string said = folder.path() + "/said";
  CUTICLE_ASSIGN(const Lines lines, ask_alembic({"schema", fs::absolute(path).string(), said}, said, path));
  AbcSchema found;
  for (const std::string& line : lines) {
    const std::size_t end = line.find(": ");
    if (end == std::string::npos) continue;
    (line.starts_with("refuses") ? found.refuses : found.fills_in).push_back({"unreal", line.substr(end + 2)});
  }
  return found;
}

}  // namespace cuticle::cli
