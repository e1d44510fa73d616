#include "batch/batch.h"

#include "batch/ray_window.h"
#include "model/machine.h"
#include "model/policy.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

namespace raywise {
namespace {

// What is answered at a time: rays read from the caller's arrays, as AnyRay.
template <class AnyRay>
struct RayBlock {
    const Elements& elements;
    const AnyRay* rays;
    const Query* queries;
    BatchWorkspace::PerThread& thread; // whose scratch is for whatever the block takes
    RayWindow<AnyRay>*
        keeps; // what its hits are to be kept in, until the caller's arrays are written in their order; null: they are written at once

    Scratch& scratch() const { return thread.scratch; }
    std::size_t size() const { return elements.count(); }
    PacketOf<AnyRay> packet() const { return {rays, queries, size()}; }
};

// For answers that are always written at once.
struct NothingKept {};

// A batch, a window of it after the other, cut into blocks. Rays are read as AnyRay.
template <class AnyRay>
class BatchLoop {
public:
    BatchLoop(const Tracer& tracer, const RayArrays& rays, const BatchOptions& options)
        : tracer_(tracer),
          rays_(rays),
          parallel_(options.parallel),
          ordering_(options.ordering),
          at_a_time_(tracer.rays_at_a_time()),
          worth_thread_(tracer.accel().rays_worth_thread() > 0 ? tracer.accel().rays_worth_thread()
                                                               : fewest_rays_of_thread),
          progress_(options.watch, rays.count, parallel_),
          workspace_(options.workspace != nullptr ? *options.workspace : own_, parallel_.threads()),
          // Without areas that nobody may have asked for yet: it is but an order.
          window_(rays, tracer.primitives().outer_bounds(), parallel_, progress_, workspace_.window()) {}

    // Calls body(block) for all rays, on several threads, and write(elements, hits) for the hits that it has kept. Returns how many of the rays held
    // a NaN, which body tells of its block, and notes the time. Throws Error(ERROR_CANCELLED) when it is stopped.
    template <class Body, class Write>
    std::uint64_t run(const Body& body, const Write& write) {
        const Clock::time_point start = Clock::now();
        for (std::uint64_t first = 0; first < rays_.count;) {
            std::uint64_t count = std::min<std::uint64_t>(rays_.count - first, ordering_window);
            bool sorted = ordering_ == RayOrdering::always;
            if (ordering_ == RayOrdering::where_it_pays && may_pay_to_order(first, count)) {
                const std::uint64_t on_trial = ordering_trial(count);
                window_.move_to(first, on_trial, false);
                sorted = worth_ordering(run_window(body));
                first += on_trial;
                count -= on_trial;
            }
            window_.move_to(first, count, sorted);
            run_window(body);
            if constexpr (!std::is_same_v<Write, NothingKept>) {
                if (sorted) window_.write_kept(write);
            }
            first += count;
        }
        progress_.finish();
        tracer_.usage().rays.fetch_add(rays_.count, std::memory_order_relaxed);
        tracer_.usage().batch_ns.fetch_add(static_cast<std::uint64_t>(ns_since(start)), std::memory_order_relaxed);
        std::uint64_t invalid = 0;
        for (const BatchWorkspace::PerThread& thread : workspace_.threads()) invalid += thread.invalid;
        return invalid;
    }

    const BatchWorkspace::Use& workspace() const { return workspace_; }

private:
    using Clock = std::chrono::steady_clock;
    static double ns_since(Clock::time_point start) {
        return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    }

    bool may_pay_to_order(std::uint64_t first, std::uint64_t count) const {
        return raywise::may_pay_to_order(count, tracer_.accel().bytes(), this_machine().l1_bytes) &&
               !window_.come_in_order(first, count);
    }

    template <class Body>
    void answer(BatchWorkspace::PerThread& thread, const Elements& elements, const Body& body) {
        thread.scratch.reset();
        auto* const rays = thread.scratch.take<AnyRay>(elements.count());
        window_.read(elements, rays);
        thread.skips.read(rays_.skip, elements, tracer_.primitives());
        thread.invalid += body(
            RayBlock<AnyRay>{elements, rays, thread.skips.queries(), thread, window_.is_sorted() ? &window_ : nullptr});
    }

    // Each thread takes the next block that nobody has taken, so that all end at about the same time. Returns how long a ray took in the
    // quickest of the blocks that are large enough to tell, in nanoseconds of one thread: the first of them find nothing in the caches, and
    // any may have been interrupted.
    template <class Body>
    double run_window(const Body& body) {
        const Elements& elements = window_.elements();
        const std::uint64_t count = elements.count();
        const std::uint64_t size = batch_block(count, parallel_.threads(), at_a_time_, worth_thread_);
        std::atomic<std::uint64_t> next{0};
        for (BatchWorkspace::PerThread& thread : workspace_.threads()) thread.quickest = no_time;
        const auto work = [&](std::uint64_t index) {
            BatchWorkspace::PerThread& thread = workspace_.threads()[index];
            for (;;) {
                progress_.poll();
                const std::uint64_t taken = progress_.is_watched() ? thread.pace.rays(size) : size;
                const std::uint64_t first = next.fetch_add(taken, std::memory_order_relaxed);
                if (first >= count) break;
                const std::uint64_t n = std::min(taken, count - first);
                const Clock::time_point start = Clock::now();
                answer(thread, elements.part(first, n), body);
                const double ns = ns_since(start);
                if (is_worth_timing(n)) thread.quickest = std::min(thread.quickest, ns / static_cast<double>(n));
                thread.pace.took(n, ns);
                progress_.add(n);
            }
        };
        parallel_.for_each(batch_threads(count, parallel_.threads(), worth_thread_), work);
        double quickest = no_time;
        for (const BatchWorkspace::PerThread& thread : workspace_.threads())
            quickest = std::min(quickest, thread.quickest);
        return quickest;
    }

    static constexpr double no_time = std::numeric_limits<double>::infinity();

    const Tracer& tracer_;
    const RayArrays& rays_;
    const Parallel& parallel_;
    const RayOrdering ordering_;
    const std::size_t at_a_time_;
    const std::uint64_t worth_thread_; // rays
    BatchProgress progress_;
    BatchWorkspace own_;
    BatchWorkspace::Use workspace_;
    RayWindow<AnyRay> window_;
};

// BatchLoop::run for rays of either type.
template <class Body, class Write>
std::uint64_t run_batch(const Tracer& tracer, const RayArrays& rays, const BatchOptions& options, const Body& body,
                        const Write& write) {
    return as_read(rays,
                   [&](auto any_ray) { return BatchLoop<decltype(any_ray)>(tracer, rays, options).run(body, write); });
}

} // namespace

std::uint64_t intersect_batch(const Tracer& tracer, const RayArrays& rays, const HitArrays& hits,
                              const BatchOptions& options) {
    const auto write = [&](const Elements& elements, const PrimitiveHit* found) {
        hits.write(elements, found, tracer.primitives());
    };
    const auto answer = [&](const auto& block) {
        auto* const found = block.scratch().template take<PrimitiveHit>(block.size());
        const std::uint64_t invalid = tracer.closest_many(block.packet(), found, block.scratch());
        if (block.keeps != nullptr) {
            block.keeps->keep(block.elements, found);
        } else {
            write(block.elements, found);
        }
        return invalid;
    };
    return run_batch(tracer, rays, options, answer, write);
}

std::uint64_t occluded_batch(const Tracer& tracer, const RayArrays& rays, const OutputArray& occluded,
                             const BatchOptions& options) {
    const auto answer = [&](const auto& block) {
        auto* const found = block.scratch().template take<bool>(block.size());
        occluded.prefetch(block.elements);
        const std::uint64_t invalid = tracer.any_many(block.packet(), found, block.scratch());
        occluded.write(block.elements, found);
        return invalid;
    };
    return run_batch(tracer, rays, options, answer, NothingKept{});
}

std::uint64_t intersect_all_batch(const Tracer& tracer, const RayArrays& rays, std::uint64_t* offsets,
                                  const HitArrays& hits, std::uint64_t capacity, std::uint64_t& needed,
                                  const BatchOptions& options) {
    // As float64, which is what is asked of structures for all hits.
    BatchLoop<Ray> loop(tracer, rays, options);
    HitsOfRay* const of_rays = loop.workspace().hits_of_rays(rays.count);
    const auto answer = [&](const RayBlock<Ray>& block) {
        std::vector<PrimitiveHit>& found = block.thread.hits;
        found.clear();
        auto* const ends = block.scratch().take<std::size_t>(block.size());
        const std::uint64_t invalid = tracer.all_many(block.packet(), found, ends);
        auto* const kept = block.thread.kept_hits.take<PrimitiveHit>(found.size());
        std::copy(found.begin(), found.end(), kept);
        std::size_t first = 0;
        for (std::size_t k = 0; k < block.size(); ++k) {
            of_rays[block.elements[k]] = {kept + first, ends[k] - first, 0};
            first = ends[k];
        }
        return invalid;
    };
    const std::uint64_t invalid = loop.run(answer, NothingKept{});

    std::uint64_t total = 0;
    for (std::uint64_t i = 0; i < rays.count; ++i) {
        of_rays[i].first = total;
        total += of_rays[i].count;
    }
    if (total <= capacity) {
        const std::uint64_t block = batch_block(rays.count, options.parallel.threads(), 1);
        options.parallel.for_blocks(rays.count, block, [&](std::uint64_t begin, std::uint64_t end) {
            for (std::uint64_t i = begin; i < end; ++i) {
                const HitsOfRay& of_ray = of_rays[i];
                hits.write({of_ray.first, of_ray.count}, of_ray.hits, tracer.primitives());
            }
        });
    }
    // Last, so that an error before leaves the caller's offsets alone.
    for (std::uint64_t i = 0; i < rays.count; ++i) offsets[i] = of_rays[i].first;
    offsets[rays.count] = total;
    needed = total;
    return invalid;
}

} // namespace raywise
