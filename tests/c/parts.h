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
};
extern struct options options;

/* clang-format off */
#define PARTS(P) \
    P(cycles)           /* resets and instances by the thousand leave the memory flat */ \
    P(whole_run)        /* the default experiment, again and again with the same bits */ \
    P(access_variables) /* every variable through its getter and setter */ \
    P(logs)             /* messages that a formatting logger prints rightly */ \
    P(saved_states)     /* FMU states in memory and as bytes, whole and damaged */ \
    P(derivatives)      /* of inputs, of outputs and directional ones */ \
    P(model_exchange)   /* with a Runge-Kutta loop of the host's own */ \
    P(threads)          /* 64 instances on 8 threads */
/* clang-format on */

#define PART(name) void name(void);
PARTS(PART)
#undef PART

#endif
