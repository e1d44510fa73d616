#include "contract/sweep_watertight.h"

#include "contract/sweep_compare.h"
#include "contract/sweep_edge_rays.h"
#include "contract/sweep_layout.h"

#include <chrono>
#include <utility>

namespace raywise::sweep {
namespace {

constexpr std::size_t rays_per_block = 8192;
// Rays of a block that are asked for all hits as well, and as many from outside.
constexpr std::size_t parity_rays = 256;
constexpr std::size_t most_faults = 5;
// A linear scan takes part where it is about as fast as the others.
constexpr std::size_t scan_most_triangles = 100;

using Clock = std::chrono::steady_clock;

class Block {
public:
    Block(const ClosedScene& scene, const Subject& subject, std::uint64_t seed, std::uint64_t block)
        : scene_(scene),
          subject_(subject),
          seed_(seed),
          block_(block),
          random_{seed, hash_of(scene.mesh.name), block},
          maker_(scene, random_) {}

    WatertightCount run() {
        std::vector<rw_ray> rays;
        std::vector<bool> odd;
        for (std::size_t i = 0; i < rays_per_block; ++i) {
            // Half of them from one point, which a view may have been made for.
            const InsidePoint& from =
                i % 2 == 0 ? scene_.inside.front() : scene_.inside[random_.below(scene_.inside.size())];
            rays.push_back(maker_.from(from.point));
            odd.push_back(from.odd);
        }
        check_leaks(rays);
        rays.resize(parity_rays);
        check_parity(rays, odd, true);
        for (rw_ray& ray : rays) ray = maker_.from_outside();
        check_parity(rays, odd, false);
        return std::move(count_);
    }

private:
    void check_leaks(const std::vector<rw_ray>& rays) {
        const Manner manner = random_manner(random_, false);
        std::vector<rw_hit> closest;
        std::vector<std::uint8_t> any;
        ask_closest(subject_, rays, manner, closest);
        ask_any(subject_, rays, manner, any);
        count_.rays += rays.size();
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (is_hit(closest[i]) && any[i] == 1) continue;
            ++count_.leaks;
            note(rays[i], manner, "leak: closest " + text_of(closest[i]) + ", any " + std::to_string(any[i]));
        }
    }

    void check_parity(const std::vector<rw_ray>& rays, const std::vector<bool>& odd, bool from_inside) {
        const Manner manner = random_manner(random_, false);
        AllHits all;
        ask_all(subject_, rays, manner, all);
        count_.parity_rays += rays.size();
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const std::uint64_t crossings = all.offsets[i + 1] - all.offsets[i];
            if (crossings_are_right(crossings, from_inside, odd[i], scene_.convex)) continue;
            ++count_.parity_errors;
            std::string text = std::to_string(crossings) + " crossings from " + (from_inside ? "inside" : "outside") +
                               (scene_.convex ? " a convex mesh" : "");
            for (std::uint64_t k = all.offsets[i]; k < all.offsets[i + 1]; ++k)
                text += "\n        " + text_of(all.hits[k]);
            note(rays[i], manner, text);
        }
    }

    void note(const rw_ray& ray, const Manner& manner, const std::string& text) {
        if (count_.faults.size() >= most_faults) return;
        count_.faults.push_back(scene_.mesh.name + " (seed " + std::to_string(seed_) + ", block " +
                                std::to_string(block_) + "), " + subject_.name() + ", " + manner.text() + "\n    ray " +
                                text_of(ray) + "\n    " + text);
    }

    const ClosedScene& scene_;
    const Subject& subject_;
    std::uint64_t seed_;
    std::uint64_t block_;
    Random random_;
    EdgeRayMaker maker_;
    WatertightCount count_;
};

} // namespace

bool crossings_are_right(std::uint64_t crossings, bool from_inside, bool odd, bool convex) {
    if (!from_inside) return convex ? crossings == 0 || crossings == 2 : crossings % 2 == 0;
    return convex ? crossings == 1 : (crossings % 2 == 1) == odd;
}

WatertightCount watertight_block(const ClosedScene& scene, const Subject& subject, std::uint64_t seed,
                                 std::uint64_t block) {
    const Clock::time_point start = Clock::now();
    WatertightCount count = Block(scene, subject, seed, block).run();
    count.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return count;
}

void WatertightCount::add(const WatertightCount& other) {
    rays += other.rays;
    leaks += other.leaks;
    parity_rays += other.parity_rays;
    parity_errors += other.parity_errors;
    seconds += other.seconds;
    faults.insert(faults.end(), other.faults.begin(), other.faults.end());
}

WatertightScene::WatertightScene(ClosedScene scene, std::uint64_t seed) : scene_(std::move(scene)), seed_(seed) {}

const std::vector<Subject>& WatertightScene::built() {
    std::call_once(once_, [this] {
        const LaidOutMesh plain(scene_.mesh, MeshLayout{});
        viewed_ = committed_scene(plain.triangles(), nullptr);
        bool float32 = scene_.float32;
        for (const std::string& name : structure_names()) {
            if (name == "linear_scan" && scene_.mesh.triangles.size() > scan_most_triangles) continue;
            const LaidOutMesh mesh(scene_.mesh, MeshLayout{float32, false, false, false});
            subjects_.emplace_back(name, committed_scene(mesh.triangles(), name.c_str()));
            float32 = scene_.float32 && !float32;
        }
        for (const std::string& name : projecting_structures(viewed_.get())) {
            subjects_.emplace_back("view from inside, " + name,
                                   point_view(viewed_.get(), scene_.inside.front().point, name.c_str()));
        }
    });
    return subjects_;
}

WatertightCount WatertightScene::run(std::uint64_t block) {
    const std::vector<Subject>& subjects = built();
    return watertight_block(scene_, subjects[block % subjects.size()], seed_, block);
}

} // namespace raywise::sweep
