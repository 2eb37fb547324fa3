/* FMU states in a host's memory: many at a time, used again, as bytes in blocks of just their size, and cut
   (what is flipped: tests/interface/serialized.rs). What follows from a state has the same bits in the library as it is packaged. */
#include "parts.h"
#include "rotor.h"
#include "saved.h"

#include <stdlib.h>
#include <string.h>

enum { POINTS = 16, AFTER = 10 };

static void follows(struct rotor *rotor, int point, const fmi2Real *straight, const char *what)
{
    fmi2Real *again = new_trace(AFTER);
    run(rotor, point, AFTER, again);
    CHECK(same_bits(again, straight + (size_t)point * real_count, AFTER * real_count),
          "what follows %s of point %d has other bits", what, point);
    free(again);
}

/* The bytes lie in a block of just their size: a checker sees who reads beyond. */
static void cut(struct rotor *rotor, struct saved saved, size_t size)
{
    fmi2FMUstate state = NULL;
    fmi2Byte *part = allocated(size, 1);
    memcpy(part, saved.bytes, size);
    REFUSED(rotor, DeSerializeFMUstate, part, size, &state);
    CHECK(state == NULL, "a state of bytes cut to %zu", size);
    free(part);
}

static void damaged(struct rotor *rotor, struct saved saved)
{
    /* Fewer where a checker makes all slow. */
    size_t few = options.cycles < 1000 ? 61 : 1;
    for (size_t size = 0; size < saved.size; size += few) {
        cut(rotor, saved, size);
    }
}

void saved_states(void)
{
    fmi2FMUstate kept[POINTS] = {NULL};
    fmi2Real *straight = new_trace(POINTS + AFTER);
    struct saved saved = {NULL, 0};
    struct rotor rotor = started_rotor();
    for (int i = 0; i < POINTS + AFTER; i++) {
        if (i < POINTS) {
            DONE(&rotor, GetFMUstate, &kept[i]);
        }
        if (i == POINTS / 2) {
            saved = save(&rotor);
        }
        run(&rotor, i, 1, straight + (size_t)i * real_count);
    }
    for (int i = 0; i < POINTS; i++) {
        int point = 7 * i % POINTS;
        fmi2FMUstate object = kept[point];
        DONE(&rotor, SetFMUstate, kept[point]);
        DONE(&rotor, GetFMUstate, &kept[point]);
        CHECK(kept[point] == object, "the object is not used again");
        follows(&rotor, point, straight, "the state");
    }
    damaged(&rotor, saved);
    restore(&rotor, saved);
    follows(&rotor, POINTS / 2, straight, "the bytes");
    struct rotor other = new_rotor(fmi2CoSimulation);
    restore(&other, saved);
    follows(&other, POINTS / 2, straight, "the bytes in a new instance");
    for (int i = 0; i < POINTS; i++) {
        int point = 5 * i % POINTS;
        DONE(&rotor, FreeFMUstate, &kept[point]);
        CHECK(kept[point] == NULL, "a freed state is not null");
    }
    free_rotor(&rotor);
    free_rotor(&other);
    free(saved.bytes);
    free(straight);
}
