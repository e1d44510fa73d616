// Parallel loops over the library's own threads (oneTBB) or the host program's.
#pragma once

#include <cstdint>
#include <functional>
#include <type_traits>

namespace raywise {

class Parallel {
public:
    // What is called for each index: somebody's function, which outlives this. No copy is made and no memory taken.
    class Task {
    public:
        template <class Body, class = std::enable_if_t<!std::is_same_v<Body, Task>>>
        Task(const Body& body)
            : body_(&body),
              call_([](const void* data, std::uint64_t index) { (*static_cast<const Body*>(data))(index); }) {}
        void operator()(std::uint64_t index) const { call_(body_, index); }

    private:
        const void* body_;
        void (*call_)(const void* body, std::uint64_t index);
    };
    // A parallel-for of the host: has to call its second argument once for each index below the first.
    using Host = std::function<void(std::uint64_t count, const Task& task)>;

    // threads: at most so many; 0: as many as the process may use. host: empty for the library's own threads.
    explicit Parallel(unsigned threads = 0, Host host = {});

    // Calls task(i) for each i below count and returns when all are done. The first exception thrown by a task is thrown
    // again here, after all have ended. Throws Error(ERROR_HOST_PARALLEL) when the host's loop left out or repeated an index.
    void for_each(std::uint64_t count, const Task& task) const;

    // Splits [0, count) into blocks of at least `grain`, or one of all where there are fewer, and calls body(begin, end) for each.
    template <class Body>
    void for_blocks(std::uint64_t count, std::uint64_t grain, const Body& body) const {
        const Blocks blocks = blocks_of(count, grain);
        const auto task = [&](std::uint64_t i) {
            body(i * blocks.size, i + 1 == blocks.count ? count : (i + 1) * blocks.size);
        };
        for_each(blocks.count, task);
    }

    // The host's loop where there is one, else the caller's thread alone: for work too small for the library's own threads.
    Parallel without_own_threads() const { return host_ ? *this : Parallel(1); }

    unsigned threads() const { return threads_; }
    bool is_host() const { return static_cast<bool>(host_); } // without it, the thread that calls for_each takes part

    // Threads this process may use: as many as processors its affinity names.
    static unsigned usable_threads();

private:
    struct Blocks {
        std::uint64_t count;
        std::uint64_t size; // of all but the last
    };
    Blocks blocks_of(std::uint64_t count, std::uint64_t grain) const;

    unsigned threads_;
    Host host_;
};

} // namespace raywise
