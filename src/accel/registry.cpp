// From a structure's name to its class: the one place that includes them all.
#include "accel/accel.h"
#include "accel/bvh.h"
#include "accel/bvh_quality.h"
#include "accel/kd_tree.h"
#include "accel/linear_scan.h"
#include "accel/projected_bvh.h"
#include "accel/uniform_grid.h"

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
