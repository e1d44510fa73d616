#include "decision_table.h"

#include "numbers.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static bool colours(void) {
    const char *terminal = getenv("TERM");
    return isatty(STDOUT_FILENO) == 1 && getenv("NO_COLOR") == NULL && terminal != NULL &&
           strcmp(terminal, "dumb") != 0;
}

void decision_legend(void) {
    printf(
        "\n"
        "  >  chosen by the library          *  soonest in fact\n"
        "  ~  extrapolated: not all of the rays were timed\n"
        "  said: predicted before building   took: measured here with the structure forced\n"
        "  total = build + rays; regret = (choosing + chosen) / soonest - 1\n");
}

const char *decision_regret(struct number *number, double regret) {
    if (isnan(regret))
        strcpy(number->text, "-");
    else if (regret < 9.995)
        snprintf(number->text, sizeof number->text, "%.1f %%", 100.0 * regret);
    else
        snprintf(number->text, sizeof number->text, "%.0f x", regret);
    return number->text;
}

static void print_candidate(const struct decision *decision, uint32_t index, bool colour) {
    const struct candidate *candidate = &decision->candidates[index];
    const rw_candidate *said = &candidate->said;
    const bool chosen = index == decision->chosen;
    const bool best = index == decision->best;
    printf("%s%c%c %-14s", colour && chosen ? "\033[1m" : "", chosen ? '>' : ' ', best ? '*' : ' ', said->structure);
    if (said->flags & RW_CANDIDATE_NOT_APPLICABLE) {
        printf(" %8s %8s %9s %9s %8s %9s %9s %11s", "-", "-", "-", "-", "-", "-", "-", "n/a");
    } else {
        const bool part = candidate->applicable && candidate->timed < decision->rays;
        const char mark = part ? '~' : 0;
        const double known = candidate->applicable && !candidate->build_cut ? 1.0 : NAN;
        struct number text[8];
        const char *pays = number_short(&text[7], said->break_even_rays, 0);
        if (chosen)
            pays = "chosen";
        else if (said->flags & RW_CANDIDATE_OVER_LIMIT)
            pays = "too large";
        printf(" %8s %8s %9s %9s %8s %9s %9s %11s", number_short(&text[0], said->predicted_build_ns / 1e6, 0),
               number_short(&text[1], candidate->applicable ? candidate->build_ns / 1e6 : NAN,
                            candidate->build_cut ? '>' : 0),
               number_short(&text[2], said->predicted_ray_ns, 0),
               number_short(&text[3], known * candidate->ray_ns, mark),
               number_bytes(&text[4], candidate->bytes != 0 ? candidate->bytes : said->predicted_bytes),
               number_short(&text[5], said->predicted_total_ns / 1e6, 0),
               number_short(&text[6], candidate->total_ns / 1e6, mark), pays);
    }
    printf("%s\n", colour && chosen ? "\033[0m" : "");
}

void decision_print(const struct decision *decision) {
    struct number text;
    printf("\n%s: %s", decision->title, decision->candidates[decision->chosen].said.structure);
    printf(", chosen in %s ms", number_short(&text, decision->decide_ns / 1e6, 0));
    printf("; regret %s\n", decision_regret(&text, decision->regret));
    printf("   %-14s %17s %19s %8s %19s %11s\n", "", "build ms", "ns per ray", "bytes", "total ms", "pays off");
    printf("   %-14s %8s %8s %9s %9s %8s %9s %9s %11s\n", "structure", "said", "took", "said", "took", "", "said",
           "took", "from rays");
    const bool colour = colours();
    for (uint32_t i = 0; i < decision->count; ++i) print_candidate(decision, i, colour);
    fflush(stdout);
}
