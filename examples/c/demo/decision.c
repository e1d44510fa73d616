#include "decision.h"

#include "numbers.h"

#include <stdio.h>
#include <string.h>

static bool read_candidate(const struct api *api, const rw_scene *scene, uint32_t index, rw_candidate *candidate) {
    memset(candidate, 0, sizeof *candidate);
    candidate->struct_size = sizeof *candidate;
    return api_ok(api, api->scene_get_candidate(scene, index, candidate), "rw_scene_get_candidate");
}

static bool read_candidates(const struct api *api, const rw_scene *scene, struct decision *decision) {
    uint32_t count = 0;
    if (!api_ok(api, api->scene_candidate_count(scene, &count), "rw_scene_candidate_count")) return false;
    if (count > MOST_STRUCTURES) {
        fprintf(stderr, "raywise-demo: %u structures are more than this program has room for\n", (unsigned)count);
        return false;
    }
    decision->count = count;
    decision->chosen = count;
    for (uint32_t i = 0; i < count; ++i) {
        /* The name again from the list of structures, whose texts last for ever; the candidate's belongs to a scene
         * that will be gone when the table is printed. */
        if (!read_candidate(api, scene, i, &decision->candidates[i].said) ||
            !api_ok(api, api->structure_name(i, &decision->candidates[i].said.structure), "rw_structure_name"))
            return false;
        if (decision->candidates[i].said.flags & RW_CANDIDATE_CHOSEN) decision->chosen = i;
    }
    if (decision->chosen == count) {
        fprintf(stderr, "raywise-demo: no candidate is marked as chosen\n");
        return false;
    }
    return true;
}

/* The same, and how long choosing took. */
static bool read_decision(const struct api *api, const rw_scene *scene, struct decision *decision) {
    rw_scene_statistics statistics;
    memset(&statistics, 0, sizeof statistics);
    statistics.struct_size = sizeof statistics;
    if (!api_ok(api, api->scene_get_statistics(scene, &statistics), "rw_scene_get_statistics")) return false;
    decision->decide_ns = statistics.decide_ns;
    return read_candidates(api, scene, decision);
}

/* Totals, the best candidate, and what the choice cost beyond it. */
static void judge(struct decision *decision) {
    double least = INFINITY;
    decision->best = decision->chosen;
    for (uint32_t i = 0; i < decision->count; ++i) {
        struct candidate *candidate = &decision->candidates[i];
        candidate->total_ns = candidate->applicable && !candidate->build_cut
                                  ? candidate->build_ns + candidate->ray_ns * (double)decision->rays
                                  : NAN;
        if (candidate->total_ns < least) { /* never true of a NaN */
            least = candidate->total_ns;
            decision->best = i;
        }
    }
    const double best = decision->candidates[decision->best].total_ns;
    const double chosen = decision->candidates[decision->chosen].total_ns + decision->decide_ns;
    decision->regret = chosen / best - 1.0; /* NaN when the chosen one was not measured */
}

/* Times the candidates that were built; the contestants are in the same order. */
static bool race(const struct bench *bench, struct contestant *contestants, uint32_t count, const struct ray_list *list,
                 struct decision *decision) {
    char title[64];
    snprintf(title, sizeof title, "timing %s", decision->title);
    if (!timing_race(contestants, count, list, decision->rays, bench->cap_seconds, title)) return false;
    const struct contestant *contestant = contestants;
    for (uint32_t i = 0; i < decision->count; ++i) {
        struct candidate *candidate = &decision->candidates[i];
        if (!candidate->applicable || candidate->build_cut) continue;
        candidate->ray_ns = contestant->ray_ns;
        candidate->timed = contestant->timed;
        ++contestant;
    }
    return true;
}

bool decision_scene(const struct bench *bench, struct forced_scenes *forced, const struct ray_list *list, uint64_t rays,
                    struct decision *decision) {
    const struct api *api = bench->api;
    memset(decision, 0, sizeof *decision);
    struct number number;
    snprintf(decision->title, sizeof decision->title, "%s random ray%s", number_count(&number, rays),
             rays == 1 ? "" : "s");
    decision->rays = rays;

    rw_scene *scene = NULL;
    if (!scene_make(bench, NULL, RW_RAYS_RANDOM, rays, "building the chosen structure", &scene)) return false;
    const bool read = read_decision(api, scene, decision);
    api->scene_release(scene);
    if (!read) return false;

    struct contestant contestants[MOST_STRUCTURES];
    uint32_t racing = 0;
    memset(contestants, 0, sizeof contestants);
    for (uint32_t i = 0; i < decision->count; ++i) {
        struct candidate *candidate = &decision->candidates[i];
        if (candidate->said.flags & (RW_CANDIDATE_NOT_APPLICABLE | RW_CANDIDATE_OVER_LIMIT)) continue;
        struct forced *own = &forced->scenes[i];
        if (!scene_force(bench, &candidate->said, RW_RAYS_RANDOM, rays, own)) return false;
        candidate->applicable = true;
        candidate->build_ns = own->build_ns;
        candidate->build_cut = own->cut;
        candidate->bytes = own->bytes;
        if (own->scene != NULL) contestants[racing++].target = (struct target){api, own->scene, false, bench->threads};
    }
    if (!race(bench, contestants, racing, list, decision)) return false;
    judge(decision);
    return true;
}

/* A view with a candidate's structure. *view stays NULL when there can be none. */
static bool force_view(const struct bench *bench, const rw_scene *scene, const rw_view_options *options,
                       struct candidate *candidate, uint32_t index, rw_scene **view) {
    double spent = 0.0;
    /* Three times, as scene_force does it. */
    for (int i = 0; i < 3 && (i == 0 || spent + spent / i < bench->cap_seconds * 1e9); ++i) {
        double create_ns = 0.0;
        bool unfit = false;
        bench->api->scene_release(*view);
        *view = NULL;
        if (!view_make(bench, scene, options, candidate->said.structure, view, &create_ns, &unfit,
                       &candidate->build_cut))
            return false;
        if (unfit) return true;
        candidate->applicable = true;
        if (i == 0 || create_ns < candidate->build_ns) candidate->build_ns = create_ns;
        if (candidate->build_cut) return true;
        spent += create_ns;
    }
    rw_candidate facts;
    if (!read_candidate(bench->api, *view, index, &facts)) return false;
    candidate->bytes = facts.actual_bytes;
    return true;
}

bool decision_view(const struct bench *bench, const rw_scene *scene, const rw_view_options *options,
                   const struct ray_list *list, const char *title, struct decision *decision, rw_scene **view) {
    const struct api *api = bench->api;
    memset(decision, 0, sizeof *decision);
    snprintf(decision->title, sizeof decision->title, "%s", title);
    decision->rays = options->count;

    rw_scene *chosen = NULL;
    double create_ns = 0.0;
    bool unfit = false;
    bool cut = false;
    if (!view_make(bench, scene, options, NULL, &chosen, &create_ns, &unfit, &cut)) return false;

    struct contestant contestants[MOST_STRUCTURES];
    rw_scene *views[MOST_STRUCTURES] = {NULL};
    uint32_t racing = 0;
    memset(contestants, 0, sizeof contestants);
    bool good = read_decision(api, chosen, decision);
    for (uint32_t i = 0; good && i < decision->count; ++i) {
        struct candidate *candidate = &decision->candidates[i];
        if (candidate->said.flags & (RW_CANDIDATE_NOT_APPLICABLE | RW_CANDIDATE_OVER_LIMIT)) continue;
        good = force_view(bench, scene, options, candidate, i, &views[i]);
        const bool any_hit = options->ray_kind == RW_RAYS_SHADOW;
        if (good && views[i] != NULL)
            contestants[racing++].target = (struct target){api, views[i], any_hit, bench->threads};
    }
    good = good && race(bench, contestants, racing, list, decision);
    if (good) judge(decision);
    for (uint32_t i = 0; i < MOST_STRUCTURES; ++i) api->scene_release(views[i]);
    if (good)
        *view = chosen;
    else
        api->scene_release(chosen);
    return good;
}

uint32_t decision_find(const struct decision *decision, const char *structure) {
    uint32_t i = 0;
    while (i < decision->count && strcmp(decision->candidates[i].said.structure, structure) != 0) ++i;
    return i;
}
