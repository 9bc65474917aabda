#include "core/trace.h"

#include <map>

#include "core/file.h"
#include "core/json/json.h"

namespace cuticle {

Trace::Trace() : start_(std::chrono::steady_clock::now()) {}

double Trace::now_us() const {
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start_).count();
}

void Trace::add(Span span) {
  const std::lock_guard lock(mutex_);
  spans_.push_back(std::move(span));
}

std::vector<Span> Trace::spans() const {
  const std::lock_guard lock(mutex_);
  return spans_;
}

namespace {

Json track_name(const std::string& track, int id) {
  return {{"ph", "M"}, {"name", "thread_name"}, {"pid", 1}, {"tid", id}, {"args", {{"name", track}}}};
}

Json complete_event(const Span& span, int track) {
  return {{"ph", "X"}, {"name", span.name}, {"cat", span.track}, {"pid", 1},
          {"tid", track}, {"ts", span.begin_us}, {"dur", span.duration_us}};
}

}  // namespace

Result<void> Trace::write(const std::string& path) const {
  Json events = Json::list();
  std::map<std::string, int> tracks;
  for (const Span& span : spans()) {
    const auto [track, is_new] = tracks.try_emplace(span.track, int(tracks.size()) + 1);
    if (is_new) events.push_back(track_name(span.track, track->second));
    events.push_back(complete_event(span, track->second));
  }
  const Json document = {{"traceEvents", events}, {"displayTimeUnit", "ms"}};
  return write_text_file(path, document.dump(1));
}

ScopedSpan::ScopedSpan(Trace* trace, std::string name)
    : trace_(trace), name_(std::move(name)), begin_us_(trace != nullptr ? trace->now_us() : 0) {}

ScopedSpan::~ScopedSpan() {
  if (trace_ != nullptr) trace_->add({std::move(name_), "cpu", begin_us_, trace_->now_us() - begin_us_});
}

}  // namespace cuticle
