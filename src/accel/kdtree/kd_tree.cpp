#include "accel/kdtree/kd_tree.h"

namespace raywise {

KdTree::KdTree(const BuildInput& input) : TraversedAccel(input.primitives), tree_(build_kd_tree(input)) {}

std::size_t KdTree::bytes() const {
    return sizeof *this + tree_.nodes.capacity() * sizeof(KdNode) + tree_.references.capacity() * sizeof(std::uint32_t);
}

} // namespace raywise
