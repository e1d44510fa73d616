#include "contract/sweep_agreement.h"

#include "contract/sweep_compare.h"
#include "contract/sweep_rays.h"
#include "oracle/compare.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <set>
#include <utility>

namespace raywise::sweep {
namespace {

constexpr std::size_t rays_per_block = 2048;
// Ray-triangle tests that a linear scan may take for one block's closest hits: about a tenth of the block's time.
constexpr std::uint64_t scan_budget = 300000;
// Of so many rays one is asked for all hits.
constexpr std::size_t all_step = 16;
// The judge reckons in integers of any length: some thousand times slower than the library.
constexpr std::size_t judge_most_triangles = 200;
constexpr std::uint64_t judge_every_blocks = 4;
constexpr std::size_t judge_rays = 16;
// Faults told in full, per block.
constexpr std::size_t most_faults = 5;

using Clock = std::chrono::steady_clock;

// Rays and the reference's answers to them.
struct Asked {
    std::vector<rw_ray> rays;
    std::vector<rw_hit> closest;

    Asked every(std::size_t step) const {
        Asked some;
        for (std::size_t i = 0; i < rays.size(); i += step) {
            some.rays.push_back(rays[i]);
            some.closest.push_back(closest[i]);
        }
        return some;
    }
};

// Two passes: rays that need no answers, then rays made from the first ones' hits.
Asked make_rays(const SweepScene& scene, const Subject& reference, Random& random, bool float32) {
    constexpr std::size_t first_pass = rays_per_block * 5 / 8;
    RayMaker maker(scene, random);
    Asked asked;
    const auto add = [&](const rw_ray& ray) { asked.rays.push_back(float32 ? rounded_to_float32(ray) : ray); };
    while (asked.rays.size() < first_pass) add(maker.ordinary_or_hard());
    ask_closest(reference, asked.rays, Manner{}, asked.closest);

    std::vector<std::size_t> hits;
    for (std::size_t i = 0; i < asked.closest.size(); ++i) {
        if (is_hit(asked.closest[i])) hits.push_back(i);
    }
    while (asked.rays.size() < rays_per_block) {
        if (hits.empty()) {
            add(maker.ordinary_or_hard());
        } else {
            const std::size_t i = hits[random.below(hits.size())];
            add(maker.from_hit(asked.rays[i], asked.closest[i]));
        }
    }
    const std::vector<rw_ray> second(asked.rays.begin() + static_cast<std::ptrdiff_t>(first_pass), asked.rays.end());
    std::vector<rw_hit> answers;
    ask_closest(reference, second, Manner{}, answers);
    asked.closest.insert(asked.closest.end(), answers.begin(), answers.end());
    return asked;
}

// What the contract promises to answer: components of a direction below 2^-500 of its largest count as zero.
Vec3 counted(Vec3 direction) {
    const double least = 0x1p-500 * max_component(glm::abs(direction));
    for (int axis = 0; axis < 3; ++axis) {
        if (std::fabs(direction[axis]) < least) direction[axis] = 0.0;
    }
    return direction;
}

class Block {
public:
    Block(const SweepScene& scene, std::uint64_t seed, std::uint64_t block)
        : scene_(scene), seed_(seed), block_(block), random_{seed, hash_of(scene.mesh.name), block} {}

    AgreementCount run(const Subject& reference, const std::vector<Subject>& subjects) {
        const bool float32 = random_.one_in(4);
        const Asked asked = make_rays(scene_, reference, random_, float32);
        count_.rays = asked.rays.size();
        for (const rw_hit& hit : asked.closest) count_.hits += is_hit(hit) ? 1 : 0;
        check_reference(reference, asked);
        for (const Subject& subject : subjects) {
            const std::size_t step = step_of(subject);
            if (step == 1)
                check(reference, subject, asked, random_manner(random_, float32));
            else
                check(reference, subject, asked.every(step), random_manner(random_, float32));
        }
        if (block_ % judge_every_blocks == 0 && scene_.mesh.triangles.size() <= judge_most_triangles)
            ask_judge(asked.rays);
        return std::move(count_);
    }

private:
    std::size_t step_of(const Subject& subject) const {
        if (!subject.scans()) return 1;
        const std::uint64_t tests = rays_per_block * scene_.mesh.triangles.size();
        return static_cast<std::size_t>(
            std::min<std::uint64_t>((tests + scan_budget - 1) / scan_budget, rays_per_block) + (tests == 0 ? 1 : 0));
    }

    // All hits of the reference, for the share of rays that are asked for them; and whether it agrees with itself.
    void check_reference(const Subject& reference, const Asked& asked) {
        some_ = asked.every(all_step);
        ask_all(reference, some_.rays, Manner{}, all_wanted_);
        std::set<std::size_t> wrong;
        note(compare_first(some_.closest, all_wanted_), some_.rays, reference, Manner{}, wrong);
        count_.disagreements += wrong.size();
    }

    void check(const Subject& reference, const Subject& subject, const Asked& asked, const Manner& manner) {
        std::set<std::size_t> wrong;
        ask_closest(subject, asked.rays, manner, closest_);
        note(compare_closest(asked.closest, closest_), asked.rays, subject, manner, wrong);
        ask_any(subject, asked.rays, manner, any_);
        note(compare_any(asked.closest, any_), asked.rays, subject, manner, wrong);
        if (asked.rays.size() == rays_per_block) {
            std::set<std::size_t> wrong_all;
            ask_all(subject, some_.rays, manner, all_);
            note(compare_all(all_wanted_, all_), some_.rays, subject, manner, wrong_all);
            for (const std::size_t i : wrong_all) wrong.insert(i * all_step);
        } else {
            const Asked fewer = asked.every(all_step);
            AllHits wanted;
            ask_all(reference, fewer.rays, Manner{}, wanted);
            ask_all(subject, fewer.rays, manner, all_);
            std::set<std::size_t> wrong_all;
            note(compare_all(wanted, all_), fewer.rays, subject, manner, wrong_all);
            for (const std::size_t i : wrong_all) wrong.insert(i * all_step);
        }
        count_.comparisons += asked.rays.size();
        count_.disagreements += wrong.size();
    }

    void note(const std::vector<Difference>& differences, const std::vector<rw_ray>& rays, const Subject& subject,
              const Manner& manner, std::set<std::size_t>& wrong) {
        for (const Difference& difference : differences) {
            wrong.insert(difference.ray);
            if (count_.faults.size() >= most_faults) continue;
            count_.faults.push_back(scene_.mesh.name + " (seed " + std::to_string(seed_) + ", block " +
                                    std::to_string(block_) + "), " + subject.name() + ", " + manner.text() +
                                    "\n    ray " + text_of(rays[difference.ray]) + "\n    " + difference.text);
        }
    }

    void ask_judge(const std::vector<rw_ray>& rays) {
        std::vector<Ray> traceable;
        for (std::size_t i = 0; i < rays.size() && traceable.size() < judge_rays; i += rays.size() / (2 * judge_rays)) {
            const Ray ray{origin_of(rays[i]), rays[i].tmin, counted(direction_of(rays[i])), rays[i].tmax};
            if (ray.is_traceable()) traceable.push_back(ray);
        }
        const oracle::Comparison comparison = oracle::compare_with_judge(scene_.mesh, traceable);
        count_.judge_rays += comparison.rays;
        count_.judge_disagreements += comparison.faults.size();
        for (const std::string& fault : comparison.faults) {
            if (count_.faults.size() < most_faults) count_.faults.push_back("exact judge: " + fault);
        }
    }

    const SweepScene& scene_;
    std::uint64_t seed_;
    std::uint64_t block_;
    Random random_;
    AgreementCount count_;
    Asked some_;
    AllHits all_wanted_;
    std::vector<rw_hit> closest_;
    std::vector<std::uint8_t> any_;
    AllHits all_;
};

} // namespace

AgreementCount agreement_block(const SweepScene& scene, const Subject& reference, const std::vector<Subject>& subjects,
                               std::uint64_t seed, std::uint64_t block) {
    const Clock::time_point start = Clock::now();
    AgreementCount count = Block(scene, seed, block).run(reference, subjects);
    count.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return count;
}

void AgreementCount::add(const AgreementCount& other) {
    rays += other.rays;
    hits += other.hits;
    comparisons += other.comparisons;
    disagreements += other.disagreements;
    judge_rays += other.judge_rays;
    judge_disagreements += other.judge_disagreements;
    seconds += other.seconds;
    faults.insert(faults.end(), other.faults.begin(), other.faults.end());
}

double AgreementCount::share() const {
    constexpr double least_per_comparison = 1e-6; // seconds; about the quickest answer of a scene that is hit
    constexpr double without_hits = 100.0;
    const double least = least_per_comparison * static_cast<double>(comparisons);
    return std::max(seconds, hits * 20 < rays ? without_hits * least : least);
}

AgreementScene::AgreementScene(SweepScene scene, std::size_t index, std::uint64_t seed)
    : scene_(std::move(scene)), index_(index), seed_(seed) {}

const AgreementScene::Built& AgreementScene::built() {
    std::call_once(once_, [this] {
        Subject reference = reference_of(scene_);
        std::vector<Subject> subjects = subjects_of(scene_, reference, index_);
        built_ = std::make_unique<const Built>(Built{std::move(reference), std::move(subjects)});
    });
    return *built_;
}

AgreementCount AgreementScene::run(std::uint64_t block) {
    const Built& ready = built();
    return agreement_block(scene_, ready.reference, ready.subjects, seed_, block);
}

} // namespace raywise::sweep
