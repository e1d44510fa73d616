// Parallel loops over the library's own threads (oneTBB) or the host program's.
#pragma once

#include <cstdint>
#include <functional>

namespace raywise {

class Parallel {
public:
    using Task = std::function<void(std::uint64_t index)>;
    // A parallel-for of the host: has to call its second argument once for each index below the first.
    using Host = std::function<void(std::uint64_t count, const Task& task)>;

    // threads: at most so many; 0: as many as the process may use. host: empty for the library's own threads.
    explicit Parallel(unsigned threads = 0, Host host = {});

    // Calls task(i) for each i below count and returns when all are done. The first exception thrown by a task is thrown
    // again here, after all have ended. Throws Error(ERROR_HOST_PARALLEL) when the host's loop left out or repeated an index.
    void for_each(std::uint64_t count, const Task& task) const;

    // Splits [0, count) into blocks of at least `grain`, or one of all where there are fewer, and calls body(begin, end) for each.
    void for_blocks(std::uint64_t count, std::uint64_t grain,
                    const std::function<void(std::uint64_t begin, std::uint64_t end)>& body) const;

    // The host's loop where there is one, else the caller's thread alone: for work too small for the library's own threads.
    Parallel without_own_threads() const { return host_ ? *this : Parallel(1); }

    unsigned threads() const { return threads_; }
    bool is_host() const { return static_cast<bool>(host_); } // without it, the thread that calls for_each takes part

    // Threads this process may use: as many as processors its affinity names.
    static unsigned usable_threads();

private:
    unsigned threads_;
    Host host_;
};

} // namespace raywise
