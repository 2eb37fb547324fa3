/* What an instance says: its logger formats each message as real hosts do, with the message as the format. */
#ifndef JOURNAL_H
#define JOURNAL_H

#include "fmi2.h"

#include <stdarg.h>
#include <stdbool.h>

struct journal {
    /* How many messages came since the last time somebody looked. */
    int count;
    /* The last of them, formatted. */
    fmi2Status status;
    char instance[64];
    char category[64];
    char message[1024];
};

/* The logger; its environment is a journal. */
void write_journal(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                   fmi2String message, ...);

#endif
