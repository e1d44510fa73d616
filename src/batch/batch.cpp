#include "batch/batch.h"

#include "base/scratch.h"
#include "batch/ray_window.h"
#include "model/policy.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <utility>
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
    std::uint64_t invalid = 0;      // of all of the thread's rays, how many held a NaN

    std::size_t size() const { return elements.count(); }
    RayPacket packet() const { return {rays, skips.queries(), size()}; }
};

// A batch, a window of it after the other, cut into blocks.
class BlockLoop {
public:
    BlockLoop(const Tracer& tracer, const RayArrays& rays, const Parallel& parallel, const BatchWatch& watch,
              RayOrdering ordering)
        : tracer_(tracer),
          rays_(rays),
          parallel_(parallel),
          ordering_(ordering),
          at_a_time_(tracer.rays_at_a_time()),
          worth_thread_(tracer.accel().rays_worth_thread() > 0 ? tracer.accel().rays_worth_thread()
                                                               : fewest_rays_of_thread),
          progress_(watch, rays.count, parallel),
          window_(rays, tracer.primitives(), parallel, progress_),
          blocks_(parallel.threads()) {}

    // Calls body(block) for all rays, on several threads, and at_end() after each window. Returns how many of the rays held a NaN, which
    // body tells of its block, and notes the time. Throws Error(ERROR_CANCELLED) when it is stopped.
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
        std::uint64_t invalid = 0;
        for (const RayBlock& block : blocks_) invalid += block.invalid;
        return invalid;
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
        block.invalid += body(block);
    }

    // Each thread takes the next block that nobody has taken, so that all end at about the same time, and keeps its memory from one to
    // the next.
    template <class Body>
    void run_window(const Body& body, bool is_on_trial) {
        const Elements& elements = window_.elements();
        const std::uint64_t count = elements.count();
        const std::uint64_t size = batch_block(count, parallel_.threads(), at_a_time_, worth_thread_);
        const std::uint64_t blocks = (count + size - 1) / size;
        std::atomic<std::uint64_t> next{0};
        for (RayBlock& block : blocks_) {
            block.ns_per_ray.clear();
            if (is_on_trial) block.ns_per_ray.reserve(blocks); // here, where a refusal leaves the outputs alone
        }
        parallel_.for_each(batch_threads(count, parallel_.threads(), worth_thread_), [&](std::uint64_t thread) {
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
    const std::uint64_t worth_thread_; // rays
    BatchProgress progress_;
    RayWindow window_;
    std::vector<RayBlock> blocks_; // of each thread
};

} // namespace

std::uint64_t intersect_batch(const Tracer& tracer, const RayArrays& rays, const HitArrays& hits,
                              const Parallel& parallel, const BatchWatch& watch, RayOrdering ordering) {
    BlockLoop loop(tracer, rays, parallel, watch, ordering);
    const auto answer = [&](RayBlock& block) {
        Hit* const found = block.scratch.take<Hit>(block.size());
        const std::uint64_t invalid = tracer.closest_many(block.packet(), found, block.scratch);
        loop.window().write(block.elements, found, hits);
        return invalid;
    };
    return loop.run(answer, [&] { loop.window().finish(hits); });
}

std::uint64_t occluded_batch(const Tracer& tracer, const RayArrays& rays, const OutputArray& occluded,
                             const Parallel& parallel, const BatchWatch& watch, RayOrdering ordering) {
    return BlockLoop(tracer, rays, parallel, watch, ordering).run([&](RayBlock& block) {
        bool* const found = block.scratch.take<bool>(block.size());
        const std::uint64_t invalid = tracer.any_many(block.packet(), found, block.scratch);
        occluded.write(block.elements, found);
        return invalid;
    });
}

std::uint64_t intersect_all_batch(const Tracer& tracer, const RayArrays& rays, std::uint64_t* offsets,
                                  const HitArrays& hits, std::uint64_t capacity, std::uint64_t& needed,
                                  const Parallel& parallel, const BatchWatch& watch, RayOrdering ordering) {
    std::vector<std::vector<Hit>> found(rays.count);
    const std::uint64_t invalid = BlockLoop(tracer, rays, parallel, watch, ordering).run([&](RayBlock& block) {
        std::vector<std::vector<Hit>> of_block(block.size());
        const std::uint64_t invalid_of_block = tracer.all_many(block.packet(), of_block.data());
        for (std::size_t k = 0; k < block.size(); ++k) found[block.elements[k]] = std::move(of_block[k]);
        return invalid_of_block;
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
