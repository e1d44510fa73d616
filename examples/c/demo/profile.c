#include "profile.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>

extern char **environ;

const char *profile_source(int32_t source) {
    switch (source) {
        case RW_PROFILE_SOURCE_GENERIC:
            return "generic constants";
        case RW_PROFILE_SOURCE_PATH:
            return "file named on the command line";
        case RW_PROFILE_SOURCE_ENV:
            return "file named by RAYWISE_CALIBRATION";
        case RW_PROFILE_SOURCE_USER:
            return "user's cache folder";
        case RW_PROFILE_SOURCE_SYSTEM:
            return "system's folder";
        default:
            return "unknown";
    }
}

static bool load(const struct api *api, const char *path, rw_profile **profile, rw_profile_info *info) {
    *profile = NULL;
    const int32_t status = api->profile_load(path, profile);
    /* The RW_PROFILE_ statuses say why a file was passed over; there is a profile all the same. */
    if (status != RW_OK && *profile == NULL) return api_ok(api, status, "rw_profile_load");
    if (status != RW_OK) {
        const char *text = api->status_text(status);
        const char *message = api->last_error_message();
        printf("note: a calibration profile was passed over: %s\n", message[0] != '\0' ? message : text);
    }
    memset(info, 0, sizeof *info);
    info->struct_size = sizeof *info;
    return api_ok(api, api->profile_inspect(*profile, info), "rw_profile_inspect");
}

/* Runs raywise-calibrate; without a word when quiet. True when it could be run and *state tells how it ended. */
static bool run(const char *program, const char *command, const char *option, bool quiet, int *state) {
    char name[] = "raywise-calibrate";
    char *const arguments[] = {name, (char *)command, (char *)option, NULL};
    posix_spawn_file_actions_t actions;
    if (posix_spawn_file_actions_init(&actions) != 0) return false;
    if (quiet) {
        posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
        posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    }
    fflush(stdout); /* or the child's lines come before ours in a log */
    pid_t child = 0;
    const int error = posix_spawnp(&child, program, &actions, NULL, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
        printf("note: cannot run %s: %s\n", program, strerror(error));
        return false;
    }
    while (waitpid(child, state, 0) == -1)
        if (errno != EINTR) return false;
    return true;
}

/* Sees to it that there is a profile of this machine, before the library looks for one: it does so once in a process. */
static void calibrate_if_needed(const char *program) {
    int state = 0;
    if (!run(program, "check", NULL, true, &state) || !WIFEXITED(state) || WEXITSTATUS(state) != 1) return;
    printf("This machine has no calibration profile; running %s measure --quick\n", program);
    if (!run(program, "measure", "--quick", false, &state)) return;
    if (WIFEXITED(state) && WEXITSTATUS(state) != 0)
        printf(
            "note: raywise-calibrate wrote no profile (exit code %d; it refuses when the machine is too\n"
            "      busy to be measured). Going on without one.\n",
            WEXITSTATUS(state));
    else if (!WIFEXITED(state))
        printf("note: raywise-calibrate was ended by signal %d. Going on without a profile.\n",
               WIFSIGNALED(state) ? WTERMSIG(state) : 0);
}

bool profile_get(const struct api *api, const struct args *args, rw_profile **profile) {
    rw_profile_info info;
    /* Whoever names a profile, or "builtin", has decided already. */
    const bool named = args->profile != NULL || getenv("RAYWISE_CALIBRATION") != NULL;
    if (!named && args->calibrate != NULL) calibrate_if_needed(args->calibrate);
    if (!load(api, args->profile, profile, &info)) {
        api->profile_release(*profile);
        *profile = NULL;
        return false;
    }
    if (info.source == RW_PROFILE_SOURCE_GENERIC)
        printf("profile  generic constants%s\n", args->calibrate == NULL && args->profile == NULL
                                                     ? "; run raywise-calibrate, or name it with --calibrate"
                                                     : "");
    else
        printf("profile  %s, measured %s, spread %.1f %% (%s)\n", info.machine, info.date, 100.0 * info.spread,
               profile_source(info.source));
    return true;
}
