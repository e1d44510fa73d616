// Parallel-fors and progress callbacks of a host program, honest ones and others.
#pragma once

#include "fuzz/input.h"
#include "raywise/raywise.h"

#include <atomic>
#include <cstdint>

namespace raywise::fuzz {

class HostLoop {
public:
    explicit HostLoop(Input& input);

    rw_parallel_for function() const { return function_; } // null: the library's own threads
    void* user() { return this; }

    // Whether any call left an index out, ran one twice or made one up.
    bool has_misbehaved() const { return misbehaved_; }

    // Which indices to run, and how.
    enum class Manner {
        own_threads,
        in_order,
        backwards,
        two_threads,
        leaves_one_out,
        does_nothing,
        repeats_one,
        goes_beyond
    };

private:
    static void run(void* user, std::uint64_t count, rw_task task, void* data);

    Manner manner_;
    std::uint64_t chosen_; // the index it is wrong about, modulo the count
    rw_parallel_for function_ = nullptr;
    bool misbehaved_ = false;
};

// Counts, checks what it is told, and asks to stop after a number of calls.
class ProgressLog {
public:
    explicit ProgressLog(Input& input);

    rw_progress function() const { return function_; }
    void* user() { return this; }

    bool has_cancelled() const { return cancelled_; }
    int calls() const { return calls_; }

private:
    static std::int32_t report(void* user, double fraction, const char* stage);

    rw_progress function_ = nullptr;
    int stop_at_ = 0; // 0: never
    std::atomic<bool> inside_{false};
    int calls_ = 0;
    bool cancelled_ = false;
};

} // namespace raywise::fuzz
