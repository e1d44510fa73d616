// What every benchmark leaves behind: build/reports/<target>.json.
#pragma once

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace raywise::bench {

// A ratio "ours over the other's" for each scene; above 1 is better.
class Ratios {
public:
    void add(double ratio, const std::string& scene);
    bool empty() const { return count_ == 0; }
    double geomean() const;
    double worst() const { return worst_; }
    const std::string& worst_scene() const { return worst_scene_; }
    nlohmann::ordered_json json() const; // {"geomean", "worst", "worst_scene"}

private:
    double sum_of_logarithms_ = 0.0;
    std::size_t count_ = 0;
    double worst_ = 0.0;
    std::string worst_scene_;
};

struct Report {
    std::string target;
    std::string commit;
    std::string command;
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    nlohmann::ordered_json summary = nlohmann::ordered_json::object();
    nlohmann::ordered_json more = nlohmann::ordered_json::object(); // members of the benchmark's own
};

// With machine and date added; makes the folder. Throws std::runtime_error when it cannot be written.
void save(const Report& report, const std::string& path);

} // namespace raywise::bench
