/* Resets and instances by the thousand: the memory stays as it is after a warm-up, to the byte on the heap and to a few
   pages of the process. */
#include "exchange.h"
#include "parts.h"
#include "rotor.h"
#include "saved.h"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#ifdef __SANITIZE_ADDRESS__
/* Of the sanitizer's allocator; its header does not come with every compiler. */
size_t __sanitizer_get_current_allocated_bytes(void);
#endif

/* What the C library itself may touch between two looks [pages]. */
enum { PAGES = 2 };

struct usage {
    size_t heap;
    long pages;
};

/* Bytes in use on the heap. */
static size_t heap(void)
{
#ifdef __SANITIZE_ADDRESS__
    return __sanitizer_get_current_allocated_bytes();
#else
    struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
#endif
}

/* Pages of the process in memory. */
static long resident(void)
{
    long pages = -1;
    FILE *stream = fopen("/proc/self/statm", "r");
    if (stream != NULL) {
        if (fscanf(stream, "%*d %ld", &pages) != 1) {
            pages = -1;
        }
        fclose(stream);
    }
    return pages;
}

static struct usage usage(void)
{
    /* Looked at twice: what the first look frees, the C library keeps at hand and counts as used. */
    resident();
    size_t bytes = heap();
    return (struct usage){bytes, resident()};
}

static void check_growth(const char *what, struct usage before)
{
    if (!options.memory) {
        return;
    }
    struct usage after = usage();
    CHECK(after.heap == before.heap, "%s: the heap went from %zu to %zu bytes", what, before.heap, after.heap);
#ifndef __SANITIZE_ADDRESS__
    /* A sanitizer keeps what is freed, and grows. */
    CHECK(after.pages >= 0 && after.pages - before.pages <= PAGES, "%s: the process grew from %ld to %ld pages", what,
          before.pages, after.pages);
#endif
}

/* A short life from the instantiated state on: a run, a saved state in memory and as bytes, a refusal, whose message is made and
   freed, and now and then a step that cannot be done. */
static void live(struct rotor *rotor, fmi2Type type, int n)
{
    const struct variable *speed = variable("start.omega.y");
    const fmi2ValueReference none = NO_VARIABLE;
    const struct variable *most = variable("solver.max_evaluations");
    const fmi2Real too_fast = 1e100;
    const fmi2Real few = 1000;
    const struct variable *at_rest = variable("start.at_rest");
    const fmi2Boolean moves = fmi2False;
    fmi2Real value;
    bool fails = n % 10 == 9;
    if (fails) {
        DONE(rotor, SetReal, &speed->reference, 1, &too_fast);
        DONE(rotor, SetBoolean, &at_rest->reference, 1, &moves);
        /* What is free finds no limit but this one: of millions of evaluations, a hundred times, that would be minutes. */
        DONE(rotor, SetReal, &most->reference, 1, &few);
    }
    initialize(rotor);
    if (type == fmi2ModelExchange) {
        enter_continuous_time(rotor);
        fmi2Real *rates = allocated(states.count, sizeof *rates);
        fmi.GetDerivatives(rotor->component, rates, states.count);
        free(rates);
    } else if (fails) {
        CHECK(fmi.DoStep(rotor->component, time_at(0), 1.0, fmi2True) == fmi2Discard, "a step far too fast is done");
    } else {
        run(rotor, 0, 1, NULL);
    }
    REFUSED(rotor, GetReal, &none, 1, &value);
    struct saved saved = save(rotor);
    restore(rotor, saved);
    free(saved.bytes);
}

/* Lives of instances that are made and freed, or of one that is reset each time. */
static void lives(fmi2Type type, bool reset, int count)
{
    struct rotor rotor = {NULL, NULL};
    for (int n = 0; n < count; n++) {
        if (rotor.component == NULL) {
            rotor = new_rotor(type);
        }
        live(&rotor, type, n);
        if (reset) {
            DONE_PLAIN(&rotor, Reset);
        } else {
            free_rotor(&rotor);
        }
    }
    if (rotor.component != NULL) {
        free_rotor(&rotor);
    }
}

static void cycle(fmi2Type type, bool reset)
{
    /* The warm-up is a tenth. What a look leaves behind in the heap is cut up by the next lives. */
    lives(type, reset, options.cycles / 10 + 1);
    usage();
    lives(type, reset, 10);
    struct usage before = usage();
    lives(type, reset, options.cycles);
    check_growth(reset ? "fmi2Reset" : "fmi2Instantiate and fmi2FreeInstance", before);
}

void cycles(void)
{
    for (int reset = 0; reset < 2; reset++) {
        cycle(fmi2CoSimulation, reset);
        cycle(fmi2ModelExchange, reset);
    }
}
