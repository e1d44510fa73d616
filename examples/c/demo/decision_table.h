/* Decisions as tables for a terminal. */
#ifndef DEMO_DECISION_TABLE_H
#define DEMO_DECISION_TABLE_H

#include "decision.h"

/* What the marks mean; once, before the first table. */
void decision_legend(void);
void decision_print(const struct decision *decision);

/* "4.1 %", or "-" when it is not known. */
struct number;
const char *decision_regret(struct number *number, double regret);

#endif
