// The one file that sees oneTBB. The thread sanitizer does not instrument it: of a library that is not instrumented itself it
// would see the half that is in headers, and take every task for a race. base/parallel.cpp tells it what comes after what.
#include "base/scheduler.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <exception>
#include <new>

namespace raywise {
namespace {

// oneTBB comes to life with the first arena. When memory is refused in the middle of that, it does not recover, and whatever
// is asked of it next never returns. So it is tried once and left alone when it fails.
// The arena stays, or oneTBB would be gone, and come to life again, with every thread of the host that used it.
bool threads_are_there() {
    static const bool there = [] {
        try {
            static tbb::task_arena* const stays = new tbb::task_arena;
            stays->initialize();
            return true;
        } catch (const std::exception&) {
            return false;
        }
    }();
    return there;
}

} // namespace

void run_on_threads(unsigned threads, std::uint64_t times, void (*body)(void* data) noexcept, void* data) noexcept {
    if (!threads_are_there()) return;
    try {
        tbb::task_arena arena(static_cast<int>(threads));
        arena.execute([=] {
            tbb::parallel_for(
                std::uint64_t{0}, times, [=](std::uint64_t) { body(data); }, tbb::simple_partitioner());
        });
    } catch (const std::exception&) {
        // No memory or no thread; nothing else is thrown here.
    }
}

} // namespace raywise
