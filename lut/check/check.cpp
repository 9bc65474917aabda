#include "lut/check/check.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/json/json.h"
#include "lut/check/mistakes.h"
#include "lut/check/readings.h"
#include "lut/format.h"
#include "lut/probes.h"

namespace cuticle::lut::check {
namespace {

TableVerdict start_verdict(const ManifestTable& table) {
  TableVerdict verdict;
  verdict.table = table.name;
  verdict.file = table.file;
  return verdict;
}

/// A file with levels below the first, which the manifest's "mip_maps": "none" forbids.
TableVerdict mip_mapped(const ManifestTable& table, int levels) {
  TableVerdict verdict = start_verdict(table);
  verdict.mistake = {"mip-mapped", fmt::format("the file holds {} levels, the manifest one", levels),
                     "Import without mip maps and sample level 0 (textureLod, SampleLevel)."};
  return verdict;
}

Result<TableVerdict> check_file(const ManifestTable& table, const Format& format, const std::string& folder) {
  const std::string path = folder + "/" + table.file;
  CUTICLE_ASSIGN(const std::string digest, sha256_of_file(path));
  CUTICLE_ASSIGN(const int levels, format.levels(path));
  if (levels > 1) return mip_mapped(table, levels);
  CUTICLE_ASSIGN(const Image image, format.read(path));
  TableVerdict verdict = check_table(table, image);
  verdict.unchanged = digest == table.sha256;
  return verdict;
}

Json to_json(const TableVerdict& verdict) {
  Json json{{"table", verdict.table},         {"file", verdict.file},     {"passed", verdict.passed},
            {"unchanged", verdict.unchanged}, {"misfit", verdict.misfit}, {"worst", verdict.worst}};
  if (!verdict.passed)
    json["mistake"] = {
        {"name", verdict.mistake.name}, {"evidence", verdict.mistake.evidence}, {"remedy", verdict.mistake.remedy}};
  return json;
}

}  // namespace

bool Report::passed() const {
  return std::all_of(tables.begin(), tables.end(), [](const TableVerdict& verdict) { return verdict.passed; });
}

TableVerdict check_table(const ManifestTable& table, const Image& image) {
  TableVerdict verdict = start_verdict(table);
  if (image.channels() >= int(table.channels.size()) && image.width == table.size.x && image.height == table.size.y) {
    const Misfit misfit = misfit_of(table, reading_of(image));
    verdict.misfit = misfit.largest;
    verdict.worst = misfit.worst;
    verdict.passed = misfit.largest <= 1;
  }
  if (!verdict.passed) verdict.mistake = find_mistake(table, image);
  return verdict;
}

Result<Report> check_folder(const std::string& folder) {
  CUTICLE_ASSIGN(const Manifest manifest, read_manifest(folder));
  CUTICLE_ASSIGN(const Format* format, find_format(manifest.format));
  Report report{folder, manifest.model, manifest.layout, manifest.format, {}};
  for (const ManifestTable& table : manifest.tables) {
    CUTICLE_ASSIGN(report.tables.emplace_back(), check_file(table, *format, folder));
  }
  return report;
}

std::string to_json(const Report& report) {
  Json json{{"folder", report.folder},
            {"model", report.model},
            {"layout", report.layout},
            {"format", report.format},
            {"passed", report.passed()}};
  for (const TableVerdict& verdict : report.tables) json["tables"].push_back(to_json(verdict));
  return json.dump(2) + "\n";
}

}  // namespace cuticle::lut::check
