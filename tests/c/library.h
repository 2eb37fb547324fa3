/* The library of an FMU. */
#ifndef LIBRARY_H
#define LIBRARY_H

#include "fmi2.h"

/* The functions of the one library that this program loads. */
extern struct fmi2 fmi;

/* Loads it; where that fails, says why and ends the program. */
void load_library(const char *file);

#endif
