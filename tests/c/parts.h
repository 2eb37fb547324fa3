/* The parts of the host, each a file of its own, in the order in which they run. */
#ifndef PARTS_H
#define PARTS_H

#include <stdbool.h>

struct options {
    /* How often an instance is reset, and how often one is made and freed. */
    int cycles;
    /* How many communication steps a whole run has at most. */
    int steps;
    /* Whether memory is measured: not where a checker's own comes into it. */
    bool memory;
    /* A folder to write to. */
    const char *folder;
    /* This program, the sheet and the library, for the child process. */
    const char *program, *sheet, *library;
};
extern struct options options;

/* clang-format off */
#define PARTS(P) \
    P(cycles)           /* resets and instances by the thousand leave the memory flat */ \
    P(whole_run)        /* the default experiment, again and again with the same bits */ \
    P(access_variables) /* every variable through every getter and setter, in every state */ \
    P(order)            /* calls where they are not legal */ \
    P(nulls)            /* null pointers in every argument of every function */ \
    P(logs)             /* categories, and messages that a formatting logger prints rightly */ \
    P(rollback)         /* FMU states saved, used again and brought back */ \
    P(bytes)            /* FMU states as bytes, read here and in another process */ \
    P(damage)           /* damaged bytes are refused */ \
    P(signals)          /* derivatives of inputs and outputs */ \
    P(model_exchange)   /* with a Runge-Kutta loop of the host's own */ \
    P(directional)      /* directional derivatives against differences */ \
    P(threads)          /* 64 instances on 8 threads */
/* clang-format on */

#define PART(name) void name(void);
PARTS(PART)
#undef PART

/* In the child process: the bytes in this file go on as the parent noted. */
void resume(const char *file);

#endif
