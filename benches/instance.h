/* An instance of the FMU, for programs that measure: what goes wrong ends the program. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include "library.h"

/* A status other than fmi2OK ends the program with these words. */
void must(fmi2Status status, const char *what);

/* A call that must be done. */
#define MUST(function, ...) must(fmi.function(__VA_ARGS__), "fmi2" #function)

fmi2Component instantiate(fmi2Type type);

/* From 0 s, through initialization. */
void initialize(fmi2Component component);

#endif
