#include "accel/bvh/build/morton_tree.h"

#include "accel/bvh/build/morton_nodes.h"
#include "accel/bvh/write.h"
#include "accel/dense_region.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <utility>

namespace raywise {
namespace {

class MortonBuilder {
public:
    explicit MortonBuilder(const BuildInput& input)
        : input_(input),
          report_([this](std::uint64_t primitives) { report(primitives); }),
          dense_(dense_region(input.primitives)),
          frame_(scene_frame(input.primitives, dense_)),
          ranges_(input, frame_, dense_, report_) {}

    WideBvh run() {
        const Primitives& primitives = input_.primitives;
        bvh_.frame = frame_;
        make_blocks(bvh_, primitives, primitives.hittable_count());
        MortonTop top = make_morton_top(ranges_, primitives, bvh_);
        input_.parallel.for_each(top.subtrees.size(), [&](std::uint64_t i) {
            const MortonPart& root = top.roots[i];
            make_morton_subtree(ranges_, primitives, root, bvh_, top.subtrees[i].nodes);
            report(root.range.count());
        });
        bvh_.nodes = assemble(std::move(top.nodes), top.subtrees, input_.parallel);
        return std::move(bvh_);
    }

private:
    // Each primitive is reported twice: with its code, and in a leaf.
    void report(std::uint64_t primitives) {
        const double done = static_cast<double>(done_ += primitives);
        const double all = 2.0 * static_cast<double>(input_.primitives.hittable_count());
        input_.progress.report(std::min(1.0, done / all), "bvh");
    }

    const BuildInput& input_;
    const std::function<void(std::uint64_t)> report_;
    std::atomic<std::uint64_t> done_{0};
    const DenseRegion dense_;
    const SceneFrame frame_;
    MortonRanges ranges_;
    WideBvh bvh_;
};

} // namespace

WideBvh build_morton_tree(const BuildInput& input) {
    if (input.primitives.hittable_count() == 0) return {};
    return MortonBuilder(input).run();
}

} // namespace raywise
