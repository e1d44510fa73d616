// The parts of the benchmark, in one table.
#pragma once

#include "bench/session.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace raywise::bench {

struct Section {
    const char* name;
    const char* description;
    void (*measure)(SceneUnderTest& scene);
    std::string (*table)(const Session& session); // of all scenes
    bool far_apart;                               // takes scenes whose rows say so, too
};

// In the order they run.
const std::vector<Section>& sections();

// --- theirs ---

void measure_single(SceneUnderTest& scene);
std::string single_table(const Session& session);
void measure_batch(SceneUnderTest& scene);
std::string batch_table(const Session& session);
void measure_build(SceneUnderTest& scene);
std::string build_table(const Session& session);
void measure_memory(SceneUnderTest& scene);
std::string memory_table(const Session& session);
void measure_totals(SceneUnderTest& scene);
std::string totals_table(const Session& session);
void measure_regret(SceneUnderTest& scene);
std::string regret_table(const Session& session);
nlohmann::ordered_json regret_summary(const Session& session); // fractions; null where nothing was measured
void measure_frames(SceneUnderTest& scene);
std::string frames_table(const Session& session);
void measure_linear_scan(SceneUnderTest& scene);
std::string linear_scan_table(const Session& session);
void measure_hit_counts(SceneUnderTest& scene);
std::string hit_counts_table(const Session& session);
void measure_overhead(SceneUnderTest& scene);
std::string overhead_table(const Session& session);
void measure_structures(SceneUnderTest& scene);
std::string structures_table(const Session& session);
void measure_switches(SceneUnderTest& scene);
std::string switches_table(const Session& session);

} // namespace raywise::bench
