// From a structure's name to its class: the one place that includes them all.
#include "accel/accel.h"
#include "accel/bvh/bvh.h"
#include "accel/bvh/bvh_morton.h"
#include "accel/bvh/bvh_quality.h"
#include "accel/grid/uniform_grid.h"
#include "accel/kdtree/kd_tree.h"
#include "accel/projected/projected_bvh.h"
#include "accel/scan/linear_scan.h"

namespace raywise {

std::unique_ptr<Accel> build(Structure structure, const BuildInput& input) {
    switch (structure) {
#define RW_STRUCTURE(name, type) \
    case Structure::name:        \
        return std::make_unique<type>(input);
#include "base/structure_list.def"
#undef RW_STRUCTURE
    }
    throw Error(Status::ERROR_INTERNAL, "build: a structure outside the list");
}

} // namespace raywise
