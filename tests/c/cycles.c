/* Resets and instances by the thousand: the memory stays as it is after a warm-up, to the byte on the heap and to a few
   pages of the process. */
#include "parts.h"
#include "rotor.h"

#include <malloc.h>
#include <stdio.h>
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

static void short_life(fmi2Type type)
{
    struct rotor rotor = new_rotor(type);
    initialize(&rotor);
    free_rotor(&rotor);
}

static void instances(fmi2Type type)
{
    /* The warm-up is a tenth. */
    for (int i = 0; i < options.cycles / 10 + 1; i++) {
        short_life(type);
    }
    /* What a look leaves behind in the heap is cut up by the next life. */
    usage();
    short_life(type);
    struct usage before = usage();
    for (int i = 0; i < options.cycles; i++) {
        short_life(type);
    }
    check_growth("fmi2Instantiate and fmi2FreeInstance", before);
}

/* Refusals too: their messages are made and freed. */
static void one_reset(struct rotor *rotor)
{
    fmi2FMUstate state = NULL;
    fmi2Real value;
    fmi2ValueReference none = NO_VARIABLE;
    initialize(rotor);
    run(rotor, 0, 1, NULL);
    REFUSED(rotor, GetReal, &none, 1, &value);
    if (claims("CoSimulation.canGetAndSetFMUstate")) {
        DONE(rotor, GetFMUstate, &state);
        DONE(rotor, SetFMUstate, state);
        DONE(rotor, FreeFMUstate, &state);
    }
    DONE_PLAIN(rotor, Reset);
}

static void resets(void)
{
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    for (int i = 0; i < options.cycles / 10 + 1; i++) {
        one_reset(&rotor);
    }
    struct usage before = usage();
    for (int i = 0; i < options.cycles; i++) {
        one_reset(&rotor);
    }
    check_growth("fmi2Reset", before);
    free_rotor(&rotor);
}

void cycles(void)
{
    instances(fmi2CoSimulation);
    if (attribute("ModelExchange.modelIdentifier") != NULL) {
        instances(fmi2ModelExchange);
    }
    resets();
}
