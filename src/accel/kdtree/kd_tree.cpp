#include "accel/kdtree/kd_tree.h"

#include "accel/kdtree/build/build.h"
#include "accel/kdtree/traverse.h"

namespace raywise {
namespace {

constexpr double binary_part = 0.9; // of the time that building takes

} // namespace

KdTree::KdTree(const BuildInput& input, const KdTreeOptions& options)
    : primitives_(input.primitives),
      tree_(make_treelets(build_kd_tree(input, options, binary_part), input, binary_part)) {}

PrimitiveHit KdTree::closest(const Ray& ray, const Query& query) const { return trace_closest(tree_, ray, query); }
bool KdTree::any(const Ray& ray, const Query& query) const { return trace_any(tree_, ray, query); }
PrimitiveHit KdTree::closest_f32(const RayF& ray, const Query& query) const { return trace_closest(tree_, ray, query); }
bool KdTree::any_f32(const RayF& ray, const Query& query) const { return trace_any(tree_, ray, query); }

void KdTree::all(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits) const {
    AllCollector collector(ray, query, hits);
    trace_all(tree_, ray, collector);
    collector.remove_repeats();
}

} // namespace raywise
