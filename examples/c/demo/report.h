/* All results of a run, as a short summary and as a JSON file. */
#ifndef DEMO_REPORT_H
#define DEMO_REPORT_H

#include "args.h"
#include "check.h"
#include "decision.h"
#include "render.h"

enum {
    MOST_DECISIONS = 5,
    MOST_VIEWS = 2
};

struct report {
    const struct args *args;
    const struct api *api;
    const rw_profile *profile;
    const struct model *model;
    const struct decision *decisions; /* of scenes */
    uint32_t decision_count;
    const struct decision *views;
    uint32_t view_count;
    const struct picture *picture;
    const struct check *check;
};

void report_summary(const struct report *report);

/* Writes a file whose members are target, machine, date, command, rows and summary. False with a message on failure. */
bool report_json(const struct report *report, int argc, char **argv);

#endif
