#include "batch/batch.h"

#include "base/scratch.h"
#include "batch/ray_window.h"
#include "model/policy.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <vector>

namespace raywise {
namespace {

// What is answered at a time: rays read from the caller's arrays.
struct RayBlock {
    Elements elements{0, 0};
    Ray* rays = nullptr;
    SkipBlock skips;
    Scratch scratch; // for whatever the block takes
    BlockPace pace;
    std::vector<double> ns_per_ray; // of each of the thread's blocks in a window on trial

    std::size_t size() const { return elements.count(); }
};

bool takes_many(const Tracer& tracer) { return tracer.accel().rays_at_a_time() > 1; }

// A batch, a window of it after the other, cut into blocks.
class BlockLoop {
public:
    BlockLoop(const Tracer& tracer, const RayArrays& rays, const Parallel& parallel, const BatchWatch& watch,
              RayOrdering ordering)
        : tracer_(tracer),
          rays_(rays),
          parallel_(parallel),
          ordering_(ordering),
          at_a_time_(tracer.accel().rays_at_a_time()),
          progress_(watch, rays.count, parallel),
          window_(rays, tracer.primitives(), parallel, progress_),
          blocks_(parallel.threads()) {}

    // Calls body(block) for all rays, on several threads, and at_end() after each window. Returns how many of the rays held a NaN, and
    // notes the time. Throws Error(ERROR_CANCELLED) when it is stopped.
    template <class Body, class AtEnd>
    std::uint64_t run(const Body& body, const AtEnd& at_end) {
        const Clock::time_point start = Clock::now();
        for (std::uint64_t first = 0; first < rays_.count;) {
            std::uint64_t count = std::min<std::uint64_t>(rays_.count - first, ordering_window);
            bool in_order = ordering_ == RayOrdering::always;
            const std::uint64_t on_trial =
                ordering_ == RayOrdering::where_it_pays ? ordering_trial(count, at_a_time_) : 0;
            if (on_trial > 0) {
                window_.move_to(first, on_trial, false);
                run_window(body, true);
                in_order = worth_ordering(ns_per_ray());
                first += on_trial;
                count -= on_trial;
            }
            window_.move_to(first, count, in_order);
            run_window(body, false);
            at_end();
            first += count;
        }
        progress_.finish();
        tracer_.usage().rays.fetch_add(rays_.count, std::memory_order_relaxed);
        tracer_.usage().batch_ns.fetch_add(static_cast<std::uint64_t>(ns_since(start)), std::memory_order_relaxed);
        return window_.invalid();
    }
    template <class Body>
    std::uint64_t run(const Body& body) {
        return run(body, [] {});
    }

    RayWindow& window() { return window_; }

private:
    using Clock = std::chrono::steady_clock;
    static double ns_since(Clock::time_point start) {
        return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
    }

    template <class Body>
    void answer(RayBlock& block, const Elements& elements, const Body& body) {
        block.scratch.reset();
        block.elements = elements;
        block.rays = block.scratch.take<Ray>(block.size());
        window_.read(block.elements, block.rays);
        block.skips.read(rays_.skip, block.elements, tracer_.primitives());
        body(block);
    }

    // Each thread takes the next block that nobody has taken, so that all end at about the same time, and keeps its memory from one to
    // the next.
    template <class Body>
    void run_window(const Body& body, bool is_on_trial) {
        const Elements& elements = window_.elements();
        const std::uint64_t count = elements.count();
        const std::uint64_t size = batch_block(count, parallel_.threads(), at_a_time_);
        const std::uint64_t blocks = (count + size - 1) / size;
        std::atomic<std::uint64_t> next{0};
        for (RayBlock& block : blocks_) {
            block.ns_per_ray.clear();
            if (is_on_trial) block.ns_per_ray.reserve(blocks); // here, where a refusal leaves the outputs alone
        }
        parallel_.for_each(batch_threads(count, parallel_.threads()), [&](std::uint64_t thread) {
            RayBlock& block = blocks_[thread];
            for (;;) {
                progress_.poll();
                const std::uint64_t taken = progress_.is_watched() ? block.pace.rays(size) : size;
                const std::uint64_t first = next.fetch_add(taken);
                if (first >= count) break;
                const std::uint64_t n = std::min(taken, count - first);
                const Clock::time_point start = Clock::now();
                answer(block, elements.part(first, n), body);
                const double ns = ns_since(start);
                if (is_on_trial && block.ns_per_ray.size() < blocks)
                    block.ns_per_ray.push_back(ns / static_cast<double>(n));
                block.pace.took(n, ns);
                progress_.add(n);
            }
        });
    }

    // Of the last window on trial, on one thread: what a quarter of the blocks stays below. The first of them find nothing in the caches, and any
    // may have been interrupted.
    double ns_per_ray() const {
        std::vector<double> all;
        for (const RayBlock& block : blocks_) all.insert(all.end(), block.ns_per_ray.begin(), block.ns_per_ray.end());
        const auto quarter = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 4);
        std::nth_element(all.begin(), quarter, all.end());
        return *quarter;
    }

    const Tracer& tracer_;
    const RayArrays& rays_;
    const Parallel& parallel_;
    const RayOrdering ordering_;
    const std::size_t at_a_time_;
    BatchProgress progress_;
    RayWindow window_;
    std::vector<RayBlock> blocks_; // of each thread
};

// A structure that takes many rays at a time does not look for those with a NaN.
std::uint64_t count_invalid(const Tracer& tracer, std::uint64_t invalid) {
    if (takes_many(tracer)) tracer.usage().invalid_rays.fetch_add(invalid, std::memory_order_relaxed);
    return invalid;
}

// Hits to `window`, which writes them to `hits`.
void write_hits(const Tracer& tracer, const RayBlock& block, const PrimitiveHit* found, RayWindow& window,
                const HitArrays& hits) {
    constexpr std::size_t together = 64; // few enough to stay at hand between the two loops
    Hit as_asked[together];
    for (std::size_t begin = 0; begin < block.size(); begin += together) {
        const std::size_t n = std::min(together, block.size() - begin);
        for (std::size_t k = 0; k < n; ++k) {
            const std::size_t i = begin + k;
            as_asked[k] = tracer.to_caller(found[i]);
        }
        window.write(block.elements.part(begin, n), as_asked, hits);
    }
}

} // namespace

std::uint64_t intersect_batch(const Tracer& tracer, const RayArrays& rays, const HitArrays& hits,
                              const Parallel& parallel, const BatchWatch& watch, RayOrdering ordering) {
    BlockLoop loop(tracer, rays, parallel, watch, ordering);
    const auto answer = [&](RayBlock& block) {
        if (takes_many(tracer)) {
            auto* const found = block.scratch.take<PrimitiveHit>(block.size());
            tracer.accel().closest_many({block.rays, block.skips.queries(), block.size()}, found, block.scratch);
            write_hits(tracer, block, found, loop.window(), hits);
        } else {
            Hit* const found = block.scratch.take<Hit>(block.size());
            for (std::size_t k = 0; k < block.size(); ++k)
                found[k] = tracer.closest(block.rays[k], block.skips.query(k));
            loop.window().write(block.elements, found, hits);
        }
    };
    return count_invalid(tracer, loop.run(answer, [&] { loop.window().finish(hits); }));
}

std::uint64_t occluded_batch(const Tracer& tracer, const RayArrays& rays, const OutputArray& occluded,
                             const Parallel& parallel, const BatchWatch& watch, RayOrdering ordering) {
    const std::uint64_t invalid = BlockLoop(tracer, rays, parallel, watch, ordering).run([&](RayBlock& block) {
        bool* const found = block.scratch.take<bool>(block.size());
        if (takes_many(tracer)) {
            tracer.accel().any_many({block.rays, block.skips.queries(), block.size()}, found, block.scratch);
        } else {
            for (std::size_t k = 0; k < block.size(); ++k) found[k] = tracer.any(block.rays[k], block.skips.query(k));
        }
        occluded.write(block.elements, found);
    });
    return count_invalid(tracer, invalid);
}

std::uint64_t intersect_all_batch(const Tracer& tracer, const RayArrays& rays, std::uint64_t* offsets,
                                  const HitArrays& hits, std::uint64_t capacity, std::uint64_t& needed,
                                  const Parallel& parallel, const BatchWatch& watch, RayOrdering ordering) {
    std::vector<std::vector<Hit>> found(rays.count);
    const std::uint64_t invalid = BlockLoop(tracer, rays, parallel, watch, ordering).run([&](RayBlock& block) {
        for (std::size_t k = 0; k < block.size(); ++k)
            tracer.all(block.rays[k], found[block.elements[k]], block.skips.query(k));
    });
    std::vector<std::uint64_t> first(rays.count + 1, 0);
    for (std::uint64_t i = 0; i < rays.count; ++i) first[i + 1] = first[i] + found[i].size();
    if (first.back() <= capacity) {
        const std::uint64_t block = batch_block(rays.count, parallel.threads(), 1);
        parallel.for_blocks(rays.count, block, [&](std::uint64_t begin, std::uint64_t end) {
            for (std::uint64_t i = begin; i < end; ++i)
                hits.write({first[i], found[i].size()}, found[i].data(), tracer.primitives());
        });
    }
    // Last, so that an error before leaves the caller's offsets alone.
    std::copy(first.begin(), first.end(), offsets);
    needed = first.back();
    return invalid;
}

} // namespace raywise
