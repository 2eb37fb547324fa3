/* An FMU state as bytes. */
#ifndef SAVED_H
#define SAVED_H

#include "rotor.h"

struct saved {
    fmi2Byte *bytes;
    size_t size;
};

/* The instance's present state; the caller frees the bytes. */
struct saved save(struct rotor *rotor);

/* Brings such a state back. */
void restore(struct rotor *rotor, struct saved saved);

#endif
