#include "fuzz/callbacks.h"

#include "fuzz/failure.h"

#include <cstring>
#include <thread>

namespace raywise::fuzz {

HostLoop::HostLoop(Input& input) {
    static constexpr Manner manners[] = {
        Manner::own_threads, Manner::own_threads,    Manner::own_threads,  Manner::in_order,    Manner::backwards,
        Manner::two_threads, Manner::leaves_one_out, Manner::does_nothing, Manner::repeats_one, Manner::goes_beyond};
    manner_ = input.pick(manners);
    chosen_ = input.between<std::uint8_t>(0, 255);
    if (manner_ != Manner::own_threads) function_ = run;
}

void HostLoop::run(void* user, std::uint64_t count, rw_task task, void* data) {
    HostLoop& loop = *static_cast<HostLoop*>(user);
    demand(count > 0, "parallel_for was called for nothing");
    const std::uint64_t chosen = loop.chosen_ % count;
    switch (loop.manner_) {
        case Manner::own_threads:
        case Manner::in_order:
            for (std::uint64_t i = 0; i < count; ++i) task(data, i);
            return;
        case Manner::backwards:
            for (std::uint64_t i = count; i-- > 0;) task(data, i);
            return;
        case Manner::two_threads: {
            std::thread other([&] {
                for (std::uint64_t i = 1; i < count; i += 2) task(data, i);
            });
            for (std::uint64_t i = 0; i < count; i += 2) task(data, i);
            other.join();
            return;
        }
        case Manner::leaves_one_out:
            for (std::uint64_t i = 0; i < count; ++i) {
                if (i != chosen) task(data, i);
            }
            break;
        case Manner::does_nothing:
            break;
        case Manner::repeats_one:
            for (std::uint64_t i = 0; i < count; ++i) task(data, i);
            task(data, chosen);
            break;
        case Manner::goes_beyond:
            for (std::uint64_t i = 0; i < count; ++i) task(data, i);
            task(data, count + chosen);
            break;
    }
    loop.misbehaved_ = true;
}

ProgressLog::ProgressLog(Input& input) {
    if (!input.one_in(2)) return;
    function_ = report;
    if (input.one_in(2)) stop_at_ = input.between(1, 12);
}

std::int32_t ProgressLog::report(void* user, double fraction, const char* stage) {
    ProgressLog& log = *static_cast<ProgressLog*>(user);
    demand(!log.inside_.exchange(true), "progress was called from two threads at once");
    demand(fraction >= 0.0 && fraction <= 1.0, "progress was told a fraction that is not between 0 and 1");
    demand(stage != nullptr && std::strlen(stage) > 0, "progress was told no stage");
    ++log.calls_;
    if (log.calls_ == log.stop_at_) log.cancelled_ = true;
    log.inside_ = false;
    return log.cancelled_ ? 1 : 0;
}

} // namespace raywise::fuzz
