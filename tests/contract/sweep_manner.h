// In which manner a question is put: none may change a bit of the answer.
#pragma once

#include "contract/sweep_random.h"
#include "contract/sweep_subject.h"

#include <cstdint>
#include <string>
#include <vector>

namespace raywise::sweep {

struct Manner {
    enum class Call {
        batch,
        host_batch,
        single
    }; // host: with a parallel-for of the caller's, which runs backwards
    enum class Order {
        as_made,
        reversed,
        shuffled
    };
    enum class Layout {
        records,
        arrays,
        float32
    }; // float32: only for rays of float32 numbers
    Call call = Call::batch;
    Order order = Order::as_made;
    Layout layout = Layout::records;
    std::uint32_t threads = 1; // 0: as many as there are
    std::uint64_t shuffle = 0; // seed of the order

    std::string text() const;
};

// float32: the rays are float32 numbers.
Manner random_manner(Random& random, bool float32);

// The hits of all rays: those of ray i are [offsets[i], offsets[i + 1]).
struct AllHits {
    std::vector<std::uint64_t> offsets;
    std::vector<rw_hit> hits;
};

// Answers in the order of the rays, whatever the manner.
void ask_closest(const Subject& subject, const std::vector<rw_ray>& rays, const Manner& manner,
                 std::vector<rw_hit>& hits);
void ask_any(const Subject& subject, const std::vector<rw_ray>& rays, const Manner& manner,
             std::vector<std::uint8_t>& hit);
void ask_all(const Subject& subject, const std::vector<rw_ray>& rays, const Manner& manner, AllHits& all);

} // namespace raywise::sweep
