// The sweeps that a case file can name: many rays of one kind, the same on every machine.
#pragma once

#include "contract/case_file.h"
#include "contract/library.h"
#include "contract/meshes.h"

#include <string>
#include <vector>

namespace raywise::contract {

// "rays KIND COUNT SEED ..." in a case file.
struct SweepKind {
    const char* name;
    std::vector<Parameter> parameters; // beyond count and seed
    bool can_do_all;                   // has an end: COUNT may be "all"
};
const std::vector<SweepKind>& sweep_kinds();
const SweepKind* sweep_kind_named(const std::string& name);

// The rays of a sweep; `factor` multiplies its count unless it takes all there are. With `float32` every number is rounded to
// float32; on vertices that are multiples of a power of two (see "grid") nothing is lost by that.
std::vector<Ray> sweep_rays(const RayLines& lines, const std::vector<Mesh>& meshes, bool float32, std::uint64_t factor);

} // namespace raywise::contract
