/* An instance: what it remembers, in which of its states a call is legal, and what the host is told where it is not.

   Included once, by linear.c. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include "equations.h"
#include "fmi2.h"

#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>

/* The states of an instance, as a set. */
enum {
    INSTANTIATED = 1,
    INITIALIZATION = 2,
    COMPLETE = 4,
    FAILED = 8,
    EVENT = 16,
    CONTINUOUS = 32,
    TERMINATED = 64,
    STEPPING = COMPLETE | FAILED,
    EXCHANGING = EVENT | CONTINUOUS,
    RUNNING = STEPPING | EXCHANGING,
    SETTABLE = INSTANTIATED | INITIALIZATION | RUNNING,
    READABLE = INITIALIZATION | RUNNING | TERMINATED,
    ANY = SETTABLE | TERMINATED
};

/* All that a saved state holds; without gaps, since it is written down as bytes. */
struct memory {
    double time, stop;       /* [s] */
    double known[COLUMNS];   /* deviations of the states, values of the inputs */
    double rates[COLUMNS];   /* of the inputs, 0 of states */
    double told_at[COLUMNS]; /* when an input or its rate was last set [s] */
    int32_t kind, phase;
};

struct instance {
    fmi2CallbackFunctions callbacks;
    const char *call; /* the function that the host called last */
    struct memory now;
    struct flow flow; /* over the last step size */
    char name[];
};

/* Tells the host what is wrong; the status. The text has no %, for hosts that take it for a format. */
static fmi2Status tell(const struct instance *of, fmi2Status status, const char *format, ...)
{
    char text[256];
    va_list values;
    int length = snprintf(text, sizeof text, "%s: ", of->call);
    va_start(values, format);
    vsnprintf(text + length, sizeof text - (size_t)length, format, values);
    va_end(values);
    if (of->callbacks.logger != NULL) {
        const char *category = status == fmi2Discard ? "logStatusDiscard" : "logStatusError";
        of->callbacks.logger(of->callbacks.componentEnvironment, of->name, status, category, text);
    }
    return status;
}

/* The instance, where the call is legal in its state; else NULL, and the host is told. */
static struct instance *entered(fmi2Component component, int legal, const char *call)
{
    struct instance *of = component;
    if (of == NULL) {
        return NULL;
    }
    of->call = call;
    if ((of->now.phase & legal) == 0) {
        tell(of, fmi2Error, "not legal in this state of the instance");
        return NULL;
    }
    return of;
}

/* Whether an array has room or values. */
static int is_there(const struct instance *of, const void *array, size_t n)
{
    return n == 0 || array != NULL || tell(of, fmi2Error, "an array is a null pointer") == fmi2OK;
}

/* Whether n references lie from `first` up to `end`. */
static int are(const struct instance *of, const fmi2ValueReference vr[], size_t n, size_t first, size_t end)
{
    if (!is_there(of, vr, n)) {
        return 0;
    }
    for (size_t i = 0; i < n; i++) {
        if (vr[i] < first || vr[i] >= end) {
            const char *name = vr[i] < COLUMNS + ROWS ? NAMES[vr[i]] : "no variable";
            tell(of, fmi2Error, "value reference %u (%s) is not one for this call now", vr[i], name);
            return 0;
        }
    }
    return 1;
}

/* Whether n numbers are finite. */
static int are_finite(const struct instance *of, fmi2Status otherwise, const double values[], size_t n)
{
    if (!is_there(of, values, n)) {
        return 0;
    }
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(values[i])) {
            tell(of, otherwise, "number %lu is not finite", (unsigned long)(i + 1));
            return 0;
        }
    }
    return 1;
}

/* Whether an array is one of all states. */
static int is_whole(const struct instance *of, const void *array, size_t n)
{
    if (n != STATES) {
        tell(of, fmi2Error, "there are %d states, not %lu", STATES, (unsigned long)n);
        return 0;
    }
    return is_there(of, array, n);
}

/* To the beginning of its life. */
static void begin(struct memory *now, int32_t kind)
{
    memset(now, 0, sizeof *now);
    memcpy(now->known, STEADY, sizeof now->known);
    now->stop = HUGE_VAL;
    now->kind = kind;
    now->phase = INSTANTIATED;
}

/* An input is set now. A value alone is held: a rate lasts only beside a value that was set at the same time. */
static void set_now(struct memory *now, size_t input)
{
    if (now->told_at[input] != now->time) {
        now->rates[input] = 0.0;
        now->told_at[input] = now->time;
    }
}

#endif
