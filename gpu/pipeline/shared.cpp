#include "gpu/detail/pipeline.h"

namespace cuticle::gpu {

std::shared_ptr<PipelineObject> SharedPipelines::find(std::uint64_t key) {
  const std::scoped_lock lock(mutex_);
  const auto found = entries_.find(key);
  if (found == entries_.end()) return nullptr;
  found->second.asked = ++clock_;
  return found->second.object;
}

void SharedPipelines::keep(std::uint64_t key, std::shared_ptr<PipelineObject> object) {
  const std::scoped_lock lock(mutex_);
  ++made_;
  entries_.insert_or_assign(key, Entry{std::move(object), ++clock_});
  if (entries_.size() > k_most) destroy_unused();
}

void SharedPipelines::destroy_unused() {
  auto oldest = entries_.end();
  for (auto entry = entries_.begin(); entry != entries_.end(); ++entry)
    if (entry->second.object.use_count() == 1 &&
        (oldest == entries_.end() || entry->second.asked < oldest->second.asked))
      oldest = entry;
  if (oldest != entries_.end()) entries_.erase(oldest);
}

std::size_t SharedPipelines::made() const {
  const std::scoped_lock lock(mutex_);
  return made_;
}

void SharedPipelines::clear() {
  const std::scoped_lock lock(mutex_);
  entries_.clear();
}

std::size_t Device::pipelines_made() const { return impl_->pipelines.made(); }

}  // namespace cuticle::gpu
