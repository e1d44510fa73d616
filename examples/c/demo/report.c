#include "report.h"

#include "decision_table.h"
#include "numbers.h"
#include "profile.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/utsname.h>
#include <time.h>

static double rate(uint64_t rays, double ns) {
    return ns > 0.0 ? (double)rays * 1e3 / ns : NAN; /* rays per ns -> million rays per s */
}

void report_summary(const struct report *report) {
    struct number a, b;
    printf("\nSummary\n");
    for (uint32_t i = 0; i < report->decision_count + report->view_count; ++i) {
        const bool view = i >= report->decision_count;
        const struct decision *decision = view ? &report->views[i - report->decision_count] : &report->decisions[i];
        const char *chosen = decision->candidates[decision->chosen].said.structure;
        printf("  %-26s %-14s regret %8s", decision->title, chosen, decision_regret(&a, decision->regret));
        if (decision->best != decision->chosen)
            printf("  (%s was soonest)", decision->candidates[decision->best].said.structure);
        printf("\n");
    }
    const struct picture *picture = report->picture;
    printf("  camera rays  %s M at %s Mray/s\n", number_short(&a, (double)picture->camera_rays / 1e6, 0),
           number_short(&b, rate(picture->camera_rays, picture->camera_ns), 0));
    printf("  shadow rays  %s M at %s Mray/s\n", number_short(&a, (double)picture->shadow_rays / 1e6, 0),
           number_short(&b, rate(picture->shadow_rays, picture->shadow_ns), 0));
    printf("  picture      %s, %u x %u, %u sample%s per pixel\n", report->args->output, (unsigned)picture->size,
           (unsigned)picture->size, (unsigned)picture->samples, picture->samples == 1 ? "" : "s");
    const struct check *check = report->check;
    if (check->different == 0)
        printf("  check        %s answers (%s hits) are those of linear_scan, bit for bit\n",
               number_count(&a, check->compared), number_count(&b, check->hits_among_them));
    else
        printf("  check        FAILED: %s of %s answers are wrong\n", number_count(&a, check->different),
               number_count(&b, check->compared));
}

static void put_text(FILE *file, const char *text) {
    fputc('"', file);
    for (; *text != '\0'; ++text) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\')
            fprintf(file, "\\%c", c);
        else if (c < 0x20)
            fprintf(file, "\\u%04x", (unsigned)c);
        else
            fputc(c, file);
    }
    fputc('"', file);
}

/* JSON has no NaN and no infinity. Unknown figures become null; "never" stands for a break-even that is never
 * reached. */
static void put_number(FILE *file, const char *name, double value) {
    fprintf(file, ", \"%s\": ", name);
    if (isnan(value))
        fprintf(file, "null");
    else if (isinf(value))
        fprintf(file, "\"never\"");
    else
        fprintf(file, "%.9g", value);
}

static void put_decision(FILE *file, const struct decision *decision, const char *kind) {
    fprintf(file, "    {\"kind\": \"%s\", \"rays\": %llu, \"chosen\": ", kind, (unsigned long long)decision->rays);
    put_text(file, decision->candidates[decision->chosen].said.structure);
    fprintf(file, ", \"best\": ");
    put_text(file, decision->candidates[decision->best].said.structure);
    put_number(file, "decide_ns", decision->decide_ns);
    put_number(file, "regret", decision->regret);
    fprintf(file, ", \"candidates\": [");
    for (uint32_t i = 0; i < decision->count; ++i) {
        const struct candidate *candidate = &decision->candidates[i];
        const bool measured = candidate->applicable && !candidate->build_cut;
        fprintf(file, "%s\n      {\"structure\": ", i > 0 ? "," : "");
        put_text(file, candidate->said.structure);
        fprintf(file, ", \"applicable\": %s", candidate->applicable ? "true" : "false");
        put_number(file, "predicted_build_ns", candidate->said.predicted_build_ns);
        put_number(file, "predicted_ray_ns", candidate->said.predicted_ray_ns);
        put_number(file, "predicted_total_ns", candidate->said.predicted_total_ns);
        put_number(file, "predicted_bytes", (double)candidate->said.predicted_bytes);
        put_number(file, "break_even_rays", candidate->said.break_even_rays);
        put_number(file, "actual_build_ns", measured ? candidate->build_ns : NAN);
        put_number(file, "actual_ray_ns", measured ? candidate->ray_ns : NAN);
        put_number(file, "actual_total_ns", candidate->total_ns);
        put_number(file, "actual_bytes", candidate->bytes != 0 ? (double)candidate->bytes : NAN);
        fprintf(file, ", \"timed_rays\": %llu}", (unsigned long long)candidate->timed);
    }
    fprintf(file, "]}");
}

bool report_json(const struct report *report, int argc, char **argv) {
    FILE *file = fopen(report->args->json, "w");
    if (file == NULL) {
        fprintf(stderr, "raywise-demo: cannot write %s: %s\n", report->args->json, strerror(errno));
        return false;
    }

    struct utsname system;
    if (uname(&system) < 0) memset(&system, 0, sizeof system);
    char date[32] = "";
    const time_t now = time(NULL);
    struct tm calendar;
    if (gmtime_r(&now, &calendar) != NULL) strftime(date, sizeof date, "%Y-%m-%dT%H:%M:%SZ", &calendar);
    rw_profile_info info;
    memset(&info, 0, sizeof info);
    info.struct_size = sizeof info;
    uint32_t version[3] = {0, 0, 0};
    report->api->version(&version[0], &version[1], &version[2]);
    const bool known = report->api->profile_inspect(report->profile, &info) == RW_OK;

    fprintf(file, "{\n  \"target\": \"demo\",\n  \"machine\": {\"system\": ");
    put_text(file, system.sysname);
    fprintf(file, ", \"release\": ");
    put_text(file, system.release);
    fprintf(file, ", \"processor\": ");
    put_text(file, system.machine);
    fprintf(file, ", \"profile\": ");
    put_text(file, known ? info.machine : "");
    fprintf(file, ", \"profile_source\": ");
    put_text(file, known ? profile_source(info.source) : "");
    fprintf(file, "},\n  \"library\": \"%u.%u.%u\",\n  \"date\": \"%s\",\n  \"command\": ", (unsigned)version[0],
            (unsigned)version[1], (unsigned)version[2], date);
    fprintf(file, "[");
    for (int i = 0; i < argc; ++i) {
        fputs(i > 0 ? ", " : "", file);
        put_text(file, argv[i]);
    }
    fprintf(file, "],\n  \"scene\": {\"name\": ");
    put_text(file, report->model->title);
    fprintf(file, ", \"triangles\": %llu, \"vertices\": %llu},\n  \"rows\": [\n",
            (unsigned long long)report->model->triangle_count, (unsigned long long)report->model->vertex_count);
    double worst = NAN;
    for (uint32_t i = 0; i < report->decision_count + report->view_count; ++i) {
        const bool view = i >= report->decision_count;
        const struct decision *decision = view ? &report->views[i - report->decision_count] : &report->decisions[i];
        put_decision(file, decision, view ? (i == report->decision_count ? "camera" : "shadow") : "random");
        fprintf(file, "%s\n", i + 1 < report->decision_count + report->view_count ? "," : "");
        if (!(decision->regret <= worst)) /* true as well while worst is NaN */
            worst = isnan(decision->regret) ? worst : decision->regret;
    }
    const struct picture *picture = report->picture;
    fprintf(file, "  ],\n  \"summary\": {\"picture\": ");
    put_text(file, report->args->output);
    fprintf(file, ", \"size\": %u, \"samples\": %u, \"camera_rays\": %llu, \"shadow_rays\": %llu",
            (unsigned)picture->size, (unsigned)picture->samples, (unsigned long long)picture->camera_rays,
            (unsigned long long)picture->shadow_rays);
    put_number(file, "camera_mrays_per_second", rate(picture->camera_rays, picture->camera_ns));
    put_number(file, "shadow_mrays_per_second", rate(picture->shadow_rays, picture->shadow_ns));
    put_number(file, "regret_max", worst);
    fprintf(file, ", \"answers_compared\": %llu, \"answers_different\": %llu}\n}\n",
            (unsigned long long)report->check->compared, (unsigned long long)report->check->different);

    const bool failed = ferror(file) != 0;
    if (fclose(file) != 0 || failed) {
        fprintf(stderr, "raywise-demo: cannot write %s\n", report->args->json);
        return false;
    }
    return true;
}
