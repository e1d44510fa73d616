// Asking: the same question to everybody who has to give the judge's answer, in every form there is.
#pragma once

#include "fuzz/asked.h"
#include "fuzz/input.h"
#include "fuzz/reference.h"
#include "fuzz/workspace.h"

#include <vector>

namespace raywise::fuzz {

void ask_single(Input& input, const Reference& reference, const std::vector<Asked>& asked);
void ask_intersect_batch(Input& input, const Reference& reference, const std::vector<Asked>& asked,
                         const Workspace& workspace);
void ask_occluded_batch(Input& input, const Reference& reference, const std::vector<Asked>& asked,
                        const Workspace& workspace);
void ask_all_batch(Input& input, const Reference& reference, const std::vector<Asked>& asked,
                   const Workspace& workspace);

// One-shot calls: the meshes of the reference, or with one more that may have to be refused.
void ask_once(Input& input, const Reference& reference, const rw_profile* profile, const Workspace& workspace);

// A scene that is not committed answers nothing.
void ask_too_early(Input& input, const rw_scene* scene);

} // namespace raywise::fuzz
