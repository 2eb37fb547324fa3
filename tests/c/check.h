/* One line for each check that fails; the program then ends with a failure. */
#ifndef CHECK_H
#define CHECK_H

#include <stdbool.h>
#include <stddef.h>

/* CHECK(condition, format, …): whether the condition holds; where not, the message is printed with file and line. */
#define CHECK(condition, ...) check_that((condition), __FILE__, __LINE__, __VA_ARGS__)

bool check_that(bool holds, const char *file, int line, const char *format, ...) __attribute__((format(printf, 4, 5)));

/* How many checks failed, and how many there were. */
int failed_checks(void);
long all_checks(void);

/* Ends the program where there is no memory. */
void *allocated(size_t count, size_t size);

#endif
