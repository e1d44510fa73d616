// What scenes and views tell about themselves.
#pragma once

#include "fuzz/asked.h"
#include "fuzz/input.h"
#include "fuzz/world.h"

#include <functional>

namespace raywise::fuzz {

// A text as rw_profile_text hands it out, asked for with and without enough room. Returns it.
using TextFunction =
    std::function<std::int32_t(std::int32_t format, char* buffer, std::uint64_t capacity, std::uint64_t* needed)>;
std::string check_text(Input& input, const char* call, std::int32_t format, const TextFunction& text);

// Both formats and one that does not exist; JSON has to be JSON.
void check_texts(Input& input, const char* call, const TextFunction& text);

// forced: the structure that was asked for; empty: any.
void check_candidates(Input& input, const Asked& asked, const std::string& forced);
void check_scene_facts(Input& input, const SceneState& scene);

} // namespace raywise::fuzz
