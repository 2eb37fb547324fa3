/* Damaged bytes: cut, longer, a bit flipped, all zero, of another scene. Each is refused, no state is made of it, and
   the instance stays as it is. */
#include "parts.h"
#include "rotor.h"
#include "saved.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

static void refused_bytes(struct rotor *rotor, const fmi2Byte *bytes, size_t size, const char *what, size_t which)
{
    fmi2FMUstate state = NULL;
    if (!REFUSED(rotor, DeSerializeFMUstate, bytes, size, &state) ||
        !CHECK(state == NULL, "a state of damaged bytes")) {
        CHECK(false, "the bytes were damaged so: %s %zu", what, which);
        if (state != NULL) {
            fmi.FreeFMUstate(rotor->component, &state);
        }
    }
}

/* The bytes lie in a block of just their size: a checker sees who reads beyond. */
static void cut(struct rotor *rotor, struct saved saved, size_t size)
{
    fmi2Byte *part = allocated(size, 1);
    memcpy(part, saved.bytes, size);
    refused_bytes(rotor, part, size, "cut to", size);
    free(part);
}

static void all_damages(struct rotor *rotor, struct saved saved)
{
    size_t few = options.cycles < 1000 ? 61 : 1;
    for (size_t size = 0; size < saved.size; size += few) {
        cut(rotor, saved, size);
    }
    cut(rotor, saved, saved.size - 1);
    for (size_t bit = 0; bit < 8 * saved.size; bit += few) {
        saved.bytes[bit / 8] ^= (fmi2Byte)(1 << bit % 8);
        refused_bytes(rotor, saved.bytes, saved.size, "flipped bit", bit);
        saved.bytes[bit / 8] ^= (fmi2Byte)(1 << bit % 8);
    }
    fmi2Byte *other = allocated(saved.size + 1, 1);
    refused_bytes(rotor, other, saved.size, "zeros", saved.size);
    memcpy(other, saved.bytes, saved.size);
    refused_bytes(rotor, other, saved.size + 1, "longer", 1);
    /* Two bytes changed for each other keep sums. */
    for (size_t i = 0; i + 1 < saved.size; i += few) {
        if (other[i] != other[i + 1]) {
            fmi2Byte swapped = other[i];
            other[i] = other[i + 1];
            other[i + 1] = swapped;
            refused_bytes(rotor, other, saved.size, "swapped", i);
            memcpy(other, saved.bytes, saved.size);
        }
    }
    free(other);
    refused_bytes(rotor, saved.bytes, SIZE_MAX, "an impossible size", 0);
}

/* Too small a place, too. */
static void small_place(struct rotor *rotor)
{
    fmi2FMUstate state = NULL;
    size_t size = 0;
    DONE(rotor, GetFMUstate, &state);
    DONE(rotor, SerializedFMUstateSize, state, &size);
    fmi2Byte *place = allocated(size, 1);
    memset(place, 0x5a, size);
    REFUSED(rotor, SerializeFMUstate, state, place, size - 1);
    REFUSED(rotor, SerializeFMUstate, state, place, 0);
    CHECK(place[0] == 0x5a, "a place too small is written to");
    free(place);
    DONE(rotor, FreeFMUstate, &state);
}

void damage(void)
{
    enum { STEPS = 5 };
    if (!claims("CoSimulation.canSerializeFMUstate")) {
        return;
    }
    fmi2Real *straight = new_trace(STEPS), *disturbed = new_trace(STEPS);
    struct rotor rotor = started_rotor();
    run(&rotor, 0, 1, NULL);
    struct saved before = save(&rotor);
    run(&rotor, 1, STEPS, straight);
    restore(&rotor, before);
    if (before.size > 0) {
        all_damages(&rotor, before);
    }
    small_place(&rotor);
    struct saved after = save(&rotor);
    CHECK(before.size == after.size && memcmp(before.bytes, after.bytes, before.size) == 0,
          "damaged bytes change the instance");
    run(&rotor, 1, STEPS, disturbed);
    CHECK(same_bits(straight, disturbed, STEPS * real_count), "after damaged bytes the run has other bits");
    free_rotor(&rotor);
    free(before.bytes);
    free(after.bytes);
    free(straight);
    free(disturbed);
}
