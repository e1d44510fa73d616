#include "batch/batch_workspace.h"

#include "base/error.h"

namespace raywise {

BatchWorkspace::Use::Use(BatchWorkspace& workspace, unsigned threads) : workspace_(workspace) {
    if (workspace.is_used_.exchange(true, std::memory_order_acquire))
        throw Error(Status::ERROR_IN_USE, "options.workspace: another batch is using it");
    try {
        if (workspace.threads_.size() < threads) workspace.threads_.resize(threads);
    } catch (...) {
        workspace.is_used_.store(false, std::memory_order_release);
        throw;
    }
    for (PerThread& thread : workspace.threads_) {
        thread.pace = {};
        thread.invalid = 0;
        thread.kept_hits.reset();
    }
}

HitsOfRay* BatchWorkspace::Use::hits_of_rays(std::size_t rays) const {
    PageArray<HitsOfRay>& array = workspace_.hits_of_rays_;
    if (array.size() < rays) array = PageArray<HitsOfRay>(rays);
    return array.data();
}

} // namespace raywise
