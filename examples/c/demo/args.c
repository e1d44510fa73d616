#include "args.h"

#include <raywise/raywise.h>

#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "Usage: raywise-demo [options]\n"
    "\n"
    "Lets raywise choose a structure for 1 to 1,000,000 rays, checks each choice against the clock, renders\n"
    "a picture with camera and shadow rays, and compares answers bit for bit with a plain scan.\n"
    "\n"
    "What to look at\n"
    "  --mesh FILE        an OBJ, PLY, OFF or STL file\n"
    "  --scene NAME       without a mesh: sphereflake (default) or terrain\n"
    "  --detail N         how fine that scene is, 1 to 5 (default 5: about half a million triangles)\n"
    "  --rays N           one more number of rays to decide for\n"
    "  --size N           width and height of the picture, 16 to 4096 (default 1024)\n"
    "  --samples N        samples per pixel, 1 or 4 (default: 4 when there is time)\n"
    "\n"
    "Where things are\n"
    "  --library PATH     libraywise.so.1 to open (default: as the loader finds it)\n"
    "  --profile FILE     calibration profile (default: this machine's)\n"
    "  --calibrate PATH   raywise-calibrate, run first when this machine has no profile\n"
    "  --output FILE      the picture (default demo.png)\n"
    "  --json FILE        the decisions and figures as JSON\n"
    "\n"
    "How to run\n"
    "  --threads N        at most so many threads (default: all)\n"
    "  --cap SECONDS      time for measuring one candidate's rays (default 1)\n"
    "  --explain          print the library's own account of its choices too\n"
    "  --help             this text\n"
    "\n"
    "Exit code: 0 all is well, 1 an answer was wrong, 2 something failed or the command line is wrong.\n";

static int parse_count(const char *option, const char *text, uint64_t lowest, uint64_t highest, uint64_t *value) {
    char *end = NULL;
    errno = 0;
    const unsigned long long number = strtoull(text, &end, 10);
    /* strtoull takes "-1" for a huge number, so the first character is looked at too. */
    if (errno != 0 || end == text || *end != '\0' || text[0] < '0' || text[0] > '9' || number < lowest ||
        number > highest) {
        fprintf(stderr, "raywise-demo: --%s %s: expected a whole number from %llu to %llu\n", option, text,
                (unsigned long long)lowest, (unsigned long long)highest);
        return 0;
    }
    *value = number;
    return 1;
}

static int parse_seconds(const char *option, const char *text, double *value) {
    char *end = NULL;
    errno = 0;
    const double number = strtod(text, &end);
    if (errno != 0 || end == text || *end != '\0' || !isfinite(number) || !(number > 0.0) || number > 3600.0) {
        fprintf(stderr, "raywise-demo: --%s %s: expected seconds, above 0 and at most 3600\n", option, text);
        return 0;
    }
    *value = number;
    return 1;
}

enum args_result args_parse(struct args *args, int argc, char **argv) {
    enum {
        LIBRARY = 1000,
        CALIBRATE,
        PROFILE,
        MESH,
        SCENE,
        DETAIL,
        RAYS,
        SIZE,
        SAMPLES,
        OUTPUT,
        JSON,
        THREADS,
        CAP,
        EXPLAIN,
        HELP
    };
    static const struct option options[] = {
        {"library", required_argument, NULL, LIBRARY},
        {"calibrate", required_argument, NULL, CALIBRATE},
        {"profile", required_argument, NULL, PROFILE},
        {"mesh", required_argument, NULL, MESH},
        {"scene", required_argument, NULL, SCENE},
        {"detail", required_argument, NULL, DETAIL},
        {"rays", required_argument, NULL, RAYS},
        {"size", required_argument, NULL, SIZE},
        {"samples", required_argument, NULL, SAMPLES},
        {"output", required_argument, NULL, OUTPUT},
        {"json", required_argument, NULL, JSON},
        {"threads", required_argument, NULL, THREADS},
        {"cap", required_argument, NULL, CAP},
        {"explain", no_argument, NULL, EXPLAIN},
        {"help", no_argument, NULL, HELP},
        {NULL, 0, NULL, 0},
    };

    memset(args, 0, sizeof *args);
    args->scene = "sphereflake";
    args->detail = 5;
    args->size = 1024;
    args->output = "demo.png";
    args->cap_seconds = 1.0;

    int scene_named = 0;
    int detail_named = 0;
    uint64_t number = 0;
    for (;;) {
        const int option = getopt_long(argc, argv, "h", options, NULL);
        if (option == -1) break;
        switch (option) {
            case LIBRARY:
                args->library = optarg;
                break;
            case CALIBRATE:
                args->calibrate = optarg;
                break;
            case PROFILE:
                args->profile = optarg;
                break;
            case MESH:
                args->mesh = optarg;
                break;
            case OUTPUT:
                args->output = optarg;
                break;
            case JSON:
                args->json = optarg;
                break;
            case EXPLAIN:
                args->explain = 1;
                break;
            case SCENE:
                if (strcmp(optarg, "sphereflake") != 0 && strcmp(optarg, "terrain") != 0) {
                    fprintf(stderr, "raywise-demo: --scene %s: there are sphereflake and terrain\n", optarg);
                    return ARGS_WRONG;
                }
                args->scene = optarg;
                scene_named = 1;
                break;
            case DETAIL:
                if (!parse_count("detail", optarg, 1, 5, &number)) return ARGS_WRONG;
                args->detail = (uint32_t)number;
                detail_named = 1;
                break;
            case RAYS:
                if (!parse_count("rays", optarg, 1, RW_RAYS_LIMIT, &args->rays)) return ARGS_WRONG;
                break;
            case SIZE:
                if (!parse_count("size", optarg, 16, 4096, &number)) return ARGS_WRONG;
                args->size = (uint32_t)number;
                break;
            case SAMPLES:
                if (!parse_count("samples", optarg, 1, 4, &number)) return ARGS_WRONG;
                if (number != 1 && number != 4) {
                    fprintf(stderr, "raywise-demo: --samples %s: 1 or 4\n", optarg);
                    return ARGS_WRONG;
                }
                args->samples = (uint32_t)number;
                break;
            case THREADS:
                if (!parse_count("threads", optarg, 1, 65536, &number)) return ARGS_WRONG;
                args->threads = (uint32_t)number;
                break;
            case CAP:
                if (!parse_seconds("cap", optarg, &args->cap_seconds)) return ARGS_WRONG;
                break;
            case 'h':
            case HELP:
                fputs(help, stdout);
                return ARGS_HELP;
            default:
                fprintf(stderr, "Try raywise-demo --help.\n");
                return ARGS_WRONG;
        }
    }
    if (optind < argc) {
        fprintf(stderr, "raywise-demo: %s: all arguments are options; a mesh is named with --mesh\n", argv[optind]);
        return ARGS_WRONG;
    }
    if (args->mesh != NULL && (scene_named || detail_named)) {
        fprintf(stderr, "raywise-demo: --mesh cannot be combined with --scene or --detail\n");
        return ARGS_WRONG;
    }
    return ARGS_RUN;
}
