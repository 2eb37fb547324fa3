#include "journal.h"

#include "check.h"

#include <stdio.h>
#include <string.h>

/* Whether the text is a format without conversions: a logger that formats it reads no argument. */
static bool is_inert(const char *format)
{
    for (; *format != '\0'; format++) {
        if (*format == '%' && *++format != '%') {
            return false;
        }
    }
    return true;
}

void write_journal(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
    struct journal *journal = environment;
    va_list arguments;
    /* What is not inert must not be formatted: it would read arguments that are not there. */
    if (!CHECK(journal != NULL && instance != NULL && category != NULL && message != NULL, "the logger got a null") ||
        !CHECK(is_inert(message), "a logger that formats would read arguments: %s", message)) {
        return;
    }
    va_start(arguments, message);
    int length = vsnprintf(journal->message, sizeof journal->message, message, arguments);
    va_end(arguments);
    CHECK(length > 0 && (size_t)length < sizeof journal->message, "a message of %d characters", length);
    CHECK(strchr(message, '\n') == NULL, "a message of several lines: %s", message);
    journal->count++;
    journal->status = status;
    snprintf(journal->instance, sizeof journal->instance, "%s", instance);
    snprintf(journal->category, sizeof journal->category, "%s", category);
}
