#include "cli/usd_files.h"

#include <filesystem>

#include <fmt/core.h>

#include "cli/abc_files.h"
#include "cli/shared_files.h"
#include "core/output_file.h"
#include "strands/gltf/strands_glb.h"

namespace cuticle::cli {

namespace {

namespace fs = std::filesystem;

/// What python/cuticle_usd ends with.
enum UsdExit { converted = 0, unreadable = 3, no_usd_core = 4, no_plug_in = 5 };

/// A folder for a USD text, which no one else can enter; gone with the object.
Result<Temporary> folder_for_text() {
  CUTICLE_ASSIGN(const std::string parent, temporary_folder());
  return Temporary::folder(parent);
}
std::string text_in(const Temporary& folder) { return folder.path() + "/groom.usda"; }

bool goes_through_usd(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  return extension == ".usd" || extension == ".usdc" || extension == ".usdz";
}

Result<void> convert(const std::string& from, const std::string& to, const std::string& named) {
  switch (run_python("cuticle_usd", {fs::absolute(from).string(), fs::absolute(to).string()})) {
    case converted:
      return {};
    case unreadable:
      return bad_input(fmt::format("{}: USD cannot read or write it", named));
    case no_plug_in:
      return bad_input(fmt::format("{}: this USD has no plug-in for the format", named), "save .usdc instead");
    default:
      return bad_input(fmt::format("{}: needs Python with usd-core", named),
                       "pip install usd-core, or convert to .usda elsewhere");
  }
}

}  // namespace

Result<strands::GroomFile> read_groom_file(const std::string& path, const strands::ReadOptions& options) {
  if (!goes_through_usd(path) && !is_abc(path)) return strands::read_groom(path, options);
  if (!fs::exists(path)) return bad_input(fmt::format("{}: no such file", path), "check the name");
  if (is_abc(path)) return read_abc(path, options);
  CUTICLE_ASSIGN(const Temporary folder, folder_for_text());
  CUTICLE_TRY(convert(path, text_in(folder), path));
  return strands::read_groom(text_in(folder), options);
}

Result<std::vector<std::string>> write_groom_file(const std::string& path, const strands::Groom& groom,
                                                  double asked_unit) {
  const double metres_per_unit = asked_unit != 0 ? asked_unit : is_abc(path) ? k_abc_unit : 1;
  if (is_abc(path)) {
    CUTICLE_TRY(write_abc(path, groom, metres_per_unit));
    return std::vector<std::string>{};
  }
  if (fs::path(path).extension() == ".glb") return strands::write_strands_glb(path, groom, metres_per_unit);
  if (!goes_through_usd(path)) return strands::write_groom(path, groom, metres_per_unit);
  CUTICLE_ASSIGN(const Temporary folder, folder_for_text());
  CUTICLE_ASSIGN(std::vector<std::string> lost, strands::write_groom(text_in(folder), groom, metres_per_unit));
  CUTICLE_TRY(
      write_through_temporary(path, [&](const std::string& name) { return convert(text_in(folder), name, path); }));
  return lost;
}

}  // namespace cuticle::cli
