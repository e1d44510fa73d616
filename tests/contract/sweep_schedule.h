// Which part gets the next block: each gets about the same time, so that slow scenes are not starved and fast ones give the
// many answers.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace raywise::sweep {

class TimeShares {
public:
    explicit TimeShares(std::size_t parts) : shares_(parts) {}

    struct Turn {
        std::size_t part;
        std::uint64_t block; // 0, 1, 2 ... for each part
        double reckoned;     // seconds it is believed to take
    };
    Turn take();
    void give_back(const Turn& turn, double seconds);

private:
    struct Share {
        double seconds = 0.0;
        double latest = 0.0; // what the block before took: reckoned with until the next one is back
        std::uint64_t blocks = 0;
    };
    std::mutex mutex_;
    std::vector<Share> shares_;
};

struct Phase {
    std::string name;
    std::size_t parts;
    std::function<double(const TimeShares::Turn& turn)> run; // seconds it took; called by several threads at once
    std::function<double()> done;                            // from 0 to 1
};

// Runs blocks on so many threads until the phase is done or `stop` is set; throws what a block has thrown. Shows progress.
void run_phase(const Phase& phase, unsigned threads, const std::atomic<bool>& stop, bool quiet);

} // namespace raywise::sweep
