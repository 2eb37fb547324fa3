/* What modelDescription.xml says of the FMU, in lines that C reads without an XML parser (written by
   xtask/src/sheet.rs):

       attribute ELEMENT.NAME VALUE
       variable REFERENCE TYPE CAUSALITY VARIABILITY START DERIVATIVE-OF NAME
       derivative REFERENCE

   TYPE is R, I (enumerations too), B or S; "-" stands for what is absent; DERIVATIVE-OF is the value reference of a
   state; the lines `derivative` are those of ModelStructure, in its order. */
#ifndef SHEET_H
#define SHEET_H

#include "fmi2.h"

#include <stdbool.h>

struct variable {
    fmi2ValueReference reference;
    char type;
    char causality[20];
    char variability[12];
    bool has_start;
    double start;
    /* The state whose derivative this is. */
    bool is_derivative;
    fmi2ValueReference state;
    char name[64];
};

/* The continuous states and their derivatives, in the order of ModelStructure. */
struct states {
    size_t count;
    fmi2ValueReference *references;
    fmi2ValueReference *derivatives;
};

extern struct variable *variables;
extern size_t variable_count;
extern struct states states;

/* Reads the sheet; where that fails, says why and ends the program. */
void read_sheet(const char *file);

/* An attribute such as "CoSimulation.modelIdentifier"; NULL where it is not there. */
const char *attribute(const char *name);

/* An attribute that is a number; 0 where it is not there. */
double number(const char *name);

/* The variable of this name; NULL where the scene has none. */
const struct variable *variable(const char *name);

/* The references of all variables of this type and this causality (NULL: any): their number, and the list, which the
   caller frees. */
size_t references_of(char type, const char *causality, fmi2ValueReference **list);

#endif
