// The one file that sees oneTBB. The thread sanitizer does not instrument it: of a library that is not instrumented itself it
// would see the half that is in headers, and take every task for a race. base/parallel.cpp tells it what comes after what.
//
// Nothing here waits for another of the host's threads, and no lock is held, so that none can be left locked in the child of a
// fork (docs/decisions/0018).
#include "base/scheduler.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <exception>
#include <memory>
#include <new>

#include <pthread.h>

namespace raywise {
namespace {

// An arena, kept for one loop after the other. oneTBB gives an arena back only after a worker has looked into it once more: of
// arenas made for one loop each, more come than go.
struct Arena {
    explicit Arena(unsigned limit) : threads(limit), arena(static_cast<int>(limit)) {}

    const unsigned threads;
    tbb::task_arena arena; // with a slot reserved for the thread that took it
    std::atomic<bool> taken{true};
    Arena* next = nullptr;
};

// All there are. They stay: without any oneTBB would be gone, and come to life again, with every thread of the host that used it.
std::atomic<Arena*> arenas{nullptr};

Arena* take_kept(unsigned threads) {
    for (Arena* each = arenas.load(); each != nullptr; each = each->next) {
        if (each->threads == threads && !each->taken.load(std::memory_order_relaxed) && !each->taken.exchange(true))
            return each;
    }
    return nullptr;
}

// Null where memory is refused.
Arena* make(unsigned threads) {
    try {
        auto made = std::make_unique<Arena>(threads);
        made->arena.initialize();
        made->next = arenas.load();
        while (!arenas.compare_exchange_weak(made->next, made.get())) {
        }
        return made.release();
    } catch (const std::exception&) {
        return nullptr;
    }
}

// An arena for a loop of this thread alone.
class Taken {
public:
    explicit Taken(unsigned threads) : arena_(take_kept(threads)) {
        if (arena_ == nullptr) arena_ = make(threads);
    }
    ~Taken() {
        if (arena_ != nullptr) arena_->taken.store(false);
    }
    Taken(const Taken&) = delete;
    Taken& operator=(const Taken&) = delete;

    tbb::task_arena* get() const { return arena_ == nullptr ? nullptr : &arena_->arena; }

private:
    Arena* arena_;
};

enum class Threads {
    not_asked_for,
    starting, // by one thread; for any other they are not there yet
    ready,
    unavailable // no memory for the start, or left behind in the parent of this process
};
std::atomic<Threads> state{Threads::not_asked_for};

// The workers are not in the child, and oneTBB's locks may be held there by threads that are not: it is not touched again.
void after_fork_in_child() { state.store(Threads::unavailable); }

// oneTBB comes to life with the first arena. When memory is refused in the middle of that, it does not recover, and whatever
// is asked of it next never returns. So it is tried once and left alone when it fails.
bool threads_are_there(unsigned threads) {
    Threads now = state.load();
    if (now == Threads::not_asked_for && state.compare_exchange_strong(now, Threads::starting)) {
        const bool started =
            pthread_atfork(nullptr, nullptr, after_fork_in_child) == 0 && Taken(threads).get() != nullptr;
        now = started ? Threads::ready : Threads::unavailable;
        state.store(now);
    }
    return now == Threads::ready;
}

} // namespace

void run_on_threads(unsigned threads, std::uint64_t times, void (*body)(void* data) noexcept, void* data) noexcept {
    if (!threads_are_there(threads)) return;
    const Taken taken(threads);
    if (taken.get() == nullptr) return;
    try {
        taken.get()->execute([=] {
            tbb::parallel_for(
                std::uint64_t{0}, times, [=](std::uint64_t) { body(data); }, tbb::simple_partitioner());
        });
    } catch (const std::exception&) {
        // No memory or no thread; nothing else is thrown here.
    }
}

std::size_t kept_arenas() {
    std::size_t count = 0;
    for (const Arena* each = arenas.load(); each != nullptr; each = each->next) ++count;
    return count;
}

} // namespace raywise
