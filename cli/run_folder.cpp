#include "cli/run_folder.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <set>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include "cli/command.h"
#include "core/file.h"
#include "core/json/json.h"
#include "core/text.h"

namespace cuticle::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* k_list = "/files.json";

/// The files that an earlier run has listed; none where there is no list, or none that can be read.
std::vector<std::string> listed_files(const std::string& folder) {
  const Result<std::string> text = read_text_file(folder + k_list);
  const Result<Json> json = text ? Json::parse(*text) : Result<Json>(text.error());
  const Json* files = json ? json->find("files") : nullptr;
  std::vector<std::string> names;
  if (files)
    for (const Json& name : *files)
      if (name.is_text()) names.push_back(name.text());
  return names;
}

}  // namespace

Result<RunFolder> RunFolder::open(const std::string& folder) {
  std::error_code failed;
  const bool is_new = !fs::exists(folder, failed);
  CUTICLE_TRY(make_folder(folder));
  const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  RunFolder opened(folder, lock, is_new);
  if (lock < 0 || ::flock(lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return opened;
  return bad_input(fmt::format("{}: another run is writing there", folder),
                   "wait for it, or name another folder by --out");
}

RunFolder::RunFolder(RunFolder&& other) noexcept
    : folder_(std::move(other.folder_)),
      is_new_(std::exchange(other.is_new_, false)),
      lock_(std::exchange(other.lock_, -1)),
      files_(std::move(other.files_)) {}

RunFolder::~RunFolder() {
  std::error_code not_empty;
  if (is_new_) fs::remove(folder_, not_empty);
  if (lock_ >= 0) ::close(lock_);
}

namespace {

/// A name whose numbers are left open: "state_#.vtp".
std::string without_numbers(const std::string& name) {
  std::string open;
  for (char c : name)
    if (c < '0' || c > '9')
      open += c;
    else if (!open.ends_with('#'))
      open += '#';
  return open;
}

/// Files in a folder that a run did not write but an earlier one did: its list names them, or, where that run was
/// killed before it wrote one, they are numbered as this run's.
std::vector<std::string> files_of_earlier_runs(const std::string& folder, const std::vector<std::string>& own) {
  std::set<std::string> kinds, earlier;
  for (const std::string& name : own) kinds.insert(without_numbers(name));
  for (const std::string& name : listed_files(folder)) earlier.insert(fs::path(name).filename().string());
  std::vector<std::string> left;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const std::string name = entry.path().filename().string();
    const bool is_numbered =
        without_numbers(name).find('#') != std::string::npos && kinds.contains(without_numbers(name));
    if (std::ranges::find(own, name) == own.end() && (is_numbered || earlier.contains(name))) left.push_back(name);
  }
  std::ranges::sort(left);
  return left;
}

}  // namespace

Result<void> RunFolder::finish(const std::string& command, bool is_complete, Progress& progress) {
  const std::vector<std::string> stale = files_of_earlier_runs(folder_, files_);
  if (!stale.empty())
    progress.message(
        fmt::format("{}: {} files of an earlier run are left, {} .. {}; files.json lists those of this run", folder_,
                    stale.size(), printable(stale.front(), 60), printable(stale.back(), 60)));
  const Json list = {{"command", command}, {"complete", is_complete}, {"files", files_}};
  return write_text_file(folder_ + k_list, list.dump(2) + "\n");
}

int in_folder(const std::string& folder, const std::function<int()>& work) {
  if (folder.empty()) return work();
  const auto mine = RunFolder::open(folder);
  return mine ? work() : report(mine.error());
}

}  // namespace cuticle::cli
