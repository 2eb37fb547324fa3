#include "saved.h"

struct saved save(struct rotor *rotor)
{
    fmi2FMUstate state = NULL;
    struct saved saved = {NULL, 0};
    DONE(rotor, GetFMUstate, &state);
    DONE(rotor, SerializedFMUstateSize, state, &saved.size);
    CHECK(saved.size > 0, "a state of no bytes");
    saved.bytes = allocated(saved.size, 1);
    DONE(rotor, SerializeFMUstate, state, saved.bytes, saved.size);
    DONE(rotor, FreeFMUstate, &state);
    return saved;
}

void restore(struct rotor *rotor, struct saved saved)
{
    fmi2FMUstate state = NULL;
    DONE(rotor, DeSerializeFMUstate, saved.bytes, saved.size, &state);
    if (CHECK(state != NULL, "no state of the bytes")) {
        DONE(rotor, SetFMUstate, state);
        DONE(rotor, FreeFMUstate, &state);
    }
}
