#include "progress.h"

#include <stdio.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

double clock_ns(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

void progress_begin(struct progress *progress, const char *title) {
    memset(progress, 0, sizeof *progress);
    snprintf(progress->title, sizeof progress->title, "%s", title);
    progress->started = clock_ns();
    progress->shown = progress->started;
    progress->terminal = isatty(STDERR_FILENO) == 1;
}

void progress_update(struct progress *progress, double fraction) {
    const double now = clock_ns();
    const double first = progress->terminal ? 0.5e9 : 2e9;
    const double every = progress->terminal ? 0.1e9 : 5e9;
    if (now - progress->started < first || (progress->visible && now - progress->shown < every)) return;
    progress->visible = true;
    progress->shown = now;
    const double seconds = (now - progress->started) / 1e9;
    fprintf(stderr, progress->terminal ? "\r  %s" : "  %s", progress->title);
    if (fraction >= 0.0) fprintf(stderr, "  %3.0f %%", 100.0 * fraction);
    fprintf(stderr, "  %.0f s", seconds);
    fputs(progress->terminal ? "\033[K" : "\n", stderr);
    fflush(stderr);
}

void progress_end(struct progress *progress) {
    if (progress->terminal && progress->visible) fputs("\r\033[K", stderr);
    progress->visible = false;
}
