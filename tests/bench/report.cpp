#include "bench/report.h"

#include "model/machine.h"

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace raywise::bench {
namespace {

std::string utc_now() {
    const std::time_t now = std::time(nullptr);
    std::tm parts{};
    ::gmtime_r(&now, &parts);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
    return text;
}

} // namespace

void Ratios::add(double ratio, const std::string& scene) {
    if (count_ == 0 || ratio < worst_) {
        worst_ = ratio;
        worst_scene_ = scene;
    }
    sum_of_logarithms_ += std::log(ratio);
    ++count_;
}

double Ratios::geomean() const { return std::exp(sum_of_logarithms_ / static_cast<double>(count_)); }

nlohmann::ordered_json Ratios::json() const {
    return {{"geomean", geomean()}, {"worst", worst_}, {"worst_scene", worst_scene_}};
}

void save(const Report& report, const std::string& path) {
    nlohmann::ordered_json document = {
        {"target", report.target},   {"machine", this_machine().brand + " (" + this_machine().key() + ")"},
        {"commit", report.commit},   {"date", utc_now()},
        {"command", report.command}, {"rows", report.rows},
        {"summary", report.summary},
    };
    document.update(report.more);
    const std::filesystem::path file(path);
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
    std::ofstream out(file);
    out << document.dump(2) << '\n';
    out.close();
    if (!out) throw std::runtime_error(path + " cannot be written");
}

} // namespace raywise::bench
