/* An instance of the FMU with its journal, and what all parts of the host do with one. */
#ifndef ROTOR_H
#define ROTOR_H

#include "check.h"
#include "journal.h"
#include "library.h"
#include "sheet.h"

struct rotor {
    fmi2Component component;
    struct journal *journal;
};

/* A value reference that no variable has. */
enum { NO_VARIABLE = 0x00ffffff };

/* A new instance that says what goes wrong; the callbacks are gone when it returns. */
struct rotor new_rotor(fmi2Type type);
void free_rotor(struct rotor *rotor);

/* From the instantiated state through initialization, at the start of the default experiment. */
void initialize(struct rotor *rotor);

/* A co-simulation instance after initialization. */
struct rotor started_rotor(void);

/* The default experiment's communication step, or a shorter one where a master would wait long for it [s]. */
double communication_step(void);

/* The time of the `i`th communication point of such steps [s]. */
double time_at(int i);

/* All variables of type Real, in the order of the sheet. */
extern fmi2ValueReference *reals;
extern size_t real_count;
void find_reals(void);

/* The bits of all Reals: two instances in the same state show the same. */
void read_reals(struct rotor *rotor, fmi2Real *values);
bool same_bits(const fmi2Real *a, const fmi2Real *b, size_t count);

/* Sets all inputs of type Real to what the host's own signal has at time `t`. */
void set_inputs(struct rotor *rotor, double t);

/* `count` communication steps from the `first` on, each with inputs set and all Reals read, into `trace` (room for
   count · real_count; NULL: not kept). */
void run(struct rotor *rotor, int first, int count, fmi2Real *trace);

/* Room for the Reals of `count` communication points; the caller frees it. */
fmi2Real *new_trace(int count);

/* Whether the call was refused: fmi2Error, and one line in the journal that begins with the function's name. */
#define REFUSED(rotor, function, ...) \
    was_refused((rotor), ((rotor)->journal->count = 0, fmi.function((rotor)->component, __VA_ARGS__)), \
                "fmi2" #function, __FILE__, __LINE__)
#define REFUSED_PLAIN(rotor, function) \
    was_refused((rotor), ((rotor)->journal->count = 0, fmi.function((rotor)->component)), "fmi2" #function, __FILE__, \
                __LINE__)
bool was_refused(struct rotor *rotor, fmi2Status status, const char *function, const char *file, int line);

/* Whether the call is done, with nothing to say. */
#define DONE(rotor, function, ...) \
    was_done((rotor), ((rotor)->journal->count = 0, fmi.function((rotor)->component, __VA_ARGS__)), "fmi2" #function, \
             __FILE__, __LINE__)
#define DONE_PLAIN(rotor, function) \
    was_done((rotor), ((rotor)->journal->count = 0, fmi.function((rotor)->component)), "fmi2" #function, __FILE__, \
             __LINE__)
bool was_done(struct rotor *rotor, fmi2Status status, const char *function, const char *file, int line);

#endif
