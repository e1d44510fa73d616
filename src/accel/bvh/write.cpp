#include "accel/bvh/write.h"

// This file is read once for each target, and the kernels compiled for it.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/bvh/write.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/bvh/write_leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace raywise::HWY_NAMESPACE {
namespace {

LeafWriter::Leaf write_leaf_kernel(WideBvh& bvh, MeshCursor& cursor, std::uint32_t first, const std::uint32_t* leaf,
                                   std::uint32_t count) {
    return write_leaf(bvh, cursor, first, leaf, count);
}

} // namespace
} // namespace raywise::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace raywise {

HWY_EXPORT(write_leaf_kernel);

void make_blocks(WideBvh& bvh, const Primitives& primitives, std::size_t triangles) {
    bvh.is_float64 = !primitives.is_float32();
    bvh.blocks = room_for_blocks(bvh.bytes_per_triangle() * triangles);
}

LeafWriter::LeafWriter(WideBvh& bvh, const Primitives& primitives) : bvh_(bvh), cursor_(primitives) {}

LeafWriter::Leaf LeafWriter::write(std::uint32_t first, const std::uint32_t* leaf, std::uint32_t count) {
    return HWY_DYNAMIC_DISPATCH(write_leaf_kernel)(bvh_, cursor_, first, leaf, count);
}

} // namespace raywise
#endif
