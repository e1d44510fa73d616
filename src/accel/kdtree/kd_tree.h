// The kd-tree: planes that part space in two, over and over, with the primitives of each part in the leaves (Bentley 1975; KdTreeAccel in Chuang's
// lecture "Acceleration"). How it is built: build/build.h. How rays walk through it, and why no hit is lost: traverse-inl.h.
#pragma once

#include "accel/accel.h"
#include "accel/kdtree/options.h"
#include "accel/kdtree/treelets.h"

#include <cstddef>
#include <vector>

namespace raywise {

class KdTree final : public Accel {
public:
    explicit KdTree(const BuildInput& input, const KdTreeOptions& options = {});

    PrimitiveHit closest(const Ray& ray, const Query& query) const override;
    bool any(const Ray& ray, const Query& query) const override;
    PrimitiveHit closest_f32(const RayF& ray, const Query& query) const override;
    bool any_f32(const RayF& ray, const Query& query) const override;
    void all(const Ray& ray, const Query& query, std::vector<PrimitiveHit>& hits) const override;

    std::size_t bytes() const override { return sizeof *this + tree_.bytes(); }
    const KdTreelets& tree() const { return tree_; }

private:
    // Where there is no tree.
    template <class Collector>
    void test_all(const Ray& ray, Collector& collector) const;

    const Primitives& primitives_;
    KdTreelets tree_;
};

} // namespace raywise
