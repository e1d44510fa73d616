#include "bench/sections/from_cold.h"

#include "rays/rays.h"

#include <algorithm>
#include <cmath>

namespace raywise::bench {

std::vector<std::uint64_t> decades_up_to(std::uint64_t most) {
    std::vector<std::uint64_t> decades;
    for (std::uint64_t decade = 1; decade <= most; decade *= 10) decades.push_back(decade);
    return decades;
}

std::string power_of_ten(std::uint64_t count) {
    return count < 1000 ? std::to_string(count)
                        : "1e" + std::to_string(std::lround(std::log10(static_cast<double>(count))));
}

std::string short_name(const std::string& structure) {
    const std::size_t underscore = structure.find('_');
    if (underscore == std::string::npos) return structure;
    if (structure.compare(0, underscore, "two") == 0) return "two";
    const std::string last = structure.substr(underscore + 1);
    return last == "tree" ? structure.substr(0, underscore) : last == "bvh" ? "proj" : last;
}

ColdRays::ColdRays(SceneUnderTest& scene, std::size_t kind, const std::vector<std::uint64_t>& decades)
    : scene_(scene),
      kind_(kind),
      question_(workloads::ray_distributions()[kind].any_hit ? Question::any : Question::closest) {
    const Effort& effort = scene.session().effort;
    const std::uint64_t affordable = affordable_rays(scene, kind, question_, effort.totals_measured, effort.totals_ns);
    for (const std::uint64_t decade : decades)
        if (decade <= affordable) most_ = decade;
    rays_ = scene.rays(kind, most_);
}

BuildRequest ColdRays::request(std::uint64_t count) const {
    BuildRequest request{scene_.mesh()};
    request.kind = kind_;
    request.count = count;
    return request;
}

ColdTime time_from_cold(const Subject& subject, const ColdRays& rays, std::uint64_t count) {
    const std::uint64_t asked = std::min(count, rays.most());
    const double start = calibration::processor_ns();
    const std::unique_ptr<Built> built = subject.build(rays.request(count));
    const double build_ns = calibration::processor_ns() - start;
    QueryRequest request{rays.rays()};
    request.question = rays.question();
    request.call = Call::batch;
    const std::unique_ptr<Query> query = built->query(request);
    const double begin = calibration::processor_ns();
    query->ask(0, asked);
    const double rays_ns = calibration::processor_ns() - begin;
    return {build_ns, rays_ns / static_cast<double>(asked), built->structure()};
}

Value value_of_times(const std::vector<double>& ms) {
    Value value;
    value.value = calibration::median(ms);
    value.spread = (calibration::quantile(ms, 0.75) - calibration::quantile(ms, 0.25)) / value.value;
    value.repetitions = static_cast<unsigned>(ms.size());
    return value;
}

} // namespace raywise::bench
