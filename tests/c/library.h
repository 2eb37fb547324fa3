/* The library of an FMU. */
#ifndef LIBRARY_H
#define LIBRARY_H

#include "fmi2.h"

#define POINTER(result, name, arguments) result(*name) arguments;
/* The functions of one library. */
struct fmi2 {
    FMI2_FUNCTIONS(POINTER)
};
#undef POINTER

/* The functions of the one library that this program loads. */
extern struct fmi2 fmi;

/* Loads it; where that fails, says why and ends the program. */
void load_library(const char *file);

#endif
