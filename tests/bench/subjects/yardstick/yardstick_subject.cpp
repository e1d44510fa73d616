// Compiled once for each processor it is measured as: RW_YARDSTICK is the function that makes it.
#include "bench/subjects/yardstick_subject.h"

#include "bench/subjects/yardstick/build.h"
#include "bench/subjects/yardstick/trace.h"

namespace raywise::bench {
namespace {

template <Question question>
class YardstickQuery : public Query {
public:
    YardstickQuery(const Tree& tree, const RaySet& rays) : tree_(tree), rays_(rays.size()) {
        for (std::size_t i = 0; i < rays.size(); ++i) {
            std::copy_n(&rays.origin[3 * i], 3, rays_[i].origin);
            std::copy_n(&rays.direction[3 * i], 3, rays_[i].direction);
            rays_[i].tmin = rays.tmin[i];
            rays_[i].tmax = rays.tmax[i];
        }
    }

    std::uint64_t ask(std::size_t first, std::size_t last) override {
        std::uint64_t hits = 0;
        for (std::size_t i = first; i < last; ++i) {
            YardstickHit hit;
            hits += trace<question == Question::any>(tree_, rays_[i], hit) ? 1 : 0;
        }
        return hits;
    }

private:
    const Tree& tree_;
    std::vector<YardstickRay> rays_;
};

class YardstickScene : public Built {
public:
    explicit YardstickScene(const workloads::Mesh& mesh) : tree_(TreeBuilder(mesh).build()) {}

    std::unique_ptr<Query> query(const QueryRequest& request) const override {
        if (request.question == Question::any)
            return std::make_unique<YardstickQuery<Question::any>>(tree_, request.rays);
        return std::make_unique<YardstickQuery<Question::closest>>(tree_, request.rays);
    }

private:
    Tree tree_;
};

class Yardstick : public Subject {
public:
    using Subject::Subject;
    std::unique_ptr<Built> build(const BuildRequest& request) const override {
        return std::make_unique<YardstickScene>(request.mesh);
    }
};

} // namespace

std::unique_ptr<Subject> RW_YARDSTICK() {
    Traits traits;
    traits.name = yardstick_name;
    traits.peer = false;
    traits.instruction_set = hwy::TargetName(HWY_STATIC_TARGET);
    traits.calls = {Call::single};
    return std::make_unique<Yardstick>(std::move(traits));
}

} // namespace raywise::bench
