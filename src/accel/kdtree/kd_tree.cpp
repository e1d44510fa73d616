#include "accel/kdtree/kd_tree.h"

#include "accel/kdtree/build/build.h"
#include "accel/kdtree/traverse.h"
#include "accel/primitive_test.h"

namespace raywise {
namespace {

constexpr double binary_part = 0.9; // of the time that building takes

} // namespace

KdTree::KdTree(const BuildInput& input, const KdTreeOptions& options)
    : primitives_(input.primitives),
      tree_(make_treelets(build_kd_tree(input, options, binary_part), input, binary_part)) {}

PrimitiveHit KdTree::closest(const Ray& ray, const Query& query) const {
    if (!tree_.too_large) return trace_closest(tree_, ray, query);
    ClosestCollector collector(ray, query);
    test_all(ray, collector);
    return collector.best();
}

bool KdTree::any(const Ray& ray, const Query& query) const {
    if (!tree_.too_large) return trace_any(tree_, ray, query);
    AnyCollector collector(ray, query);
    test_all(ray, collector);
    return collector.found();
}

PrimitiveHit KdTree::closest_f32(const RayF& ray, const Query& query) const {
    return tree_.too_large ? closest(widened(ray), query) : trace_closest(tree_, ray, query);
}

bool KdTree::any_f32(const RayF& ray, const Query& query) const {
    return tree_.too_large ? any(widened(ray), query) : trace_any(tree_, ray, query);
}

void KdTree::all(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits) const {
    AllCollector collector(ray, query, hits);
    if (tree_.too_large) {
        test_all(ray, collector);
    } else {
        trace_all(tree_, ray, collector);
    }
    collector.remove_repeats();
}

template <class Collector>
void KdTree::test_all(const Ray& ray, Collector& collector) const {
    if (ray.is_traceable()) test_all_primitives(primitives_, ExactRay(ray), collector);
}

} // namespace raywise
