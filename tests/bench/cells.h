// What was measured: one cell for each question put to all subjects. Tables, JSON rows and the summary are read off them.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace raywise::bench {

struct Value {
    std::string subject;
    bool peer = false;
    bool robust = false;
    double value = 0.0;
    double spread = 0.0; // (upper quartile - lower quartile) / median
    unsigned repetitions = 0;
    double hit_rate = -1.0;    // negative: no rays were counted
    std::string structure;     // what raywise chose
    bool extrapolated = false; // from a measured rate
    std::string instruction_set;
    double told = -1.0; // of memory: what the library itself says; negative: nothing
};

struct Cell {
    std::string section;
    std::string scene;
    std::uint64_t triangles = 0;
    std::string rays;        // the kind
    std::string query;       // closest, any
    std::uint64_t count = 0; // of rays asked
    unsigned threads = 1;
    std::string unit;
    bool higher_is_better = true;
    std::vector<Value> values;

    // nullptr when it is not there.
    const Value* of(const std::string& subject) const;
    const Value* best_peer(const std::function<bool(const Value&)>& among = {}) const;
    // Of ours over the other's; above 1 is better, whatever the unit.
    double ratio(const Value& ours, const Value& other) const;
};

using Cells = std::vector<Cell>;

// A row for each value of ours and each peer's, in which the best peer's is marked.
nlohmann::ordered_json rows_of(const Cells& cells);

} // namespace raywise::bench
