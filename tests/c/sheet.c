#include "sheet.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct attribute {
    char name[80];
    char value[256];
};

struct variable *variables;
size_t variable_count;
struct states states;

static struct attribute *attributes;
static size_t attribute_count;

/* Room for just one more at the end of a list: a checker sees who reads beyond it. */
static void *grown(void *list, size_t count, size_t size)
{
    list = realloc(list, (count + 1) * size);
    if (list == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(2);
    }
    return list;
}

static bool read_attribute(const char *line)
{
    struct attribute new;
    if (sscanf(line, "attribute %79s %255[^\n]", new.name, new.value) != 2) {
        return false;
    }
    attributes = grown(attributes, attribute_count, sizeof *attributes);
    attributes[attribute_count++] = new;
    return true;
}

static bool read_variable(const char *line)
{
    struct variable new;
    char start[40], state[20];
    if (sscanf(line, "variable %u %c %19s %11s %39s %19s %63[^\n]", &new.reference, &new.type, new.causality,
               new.variability, start, state, new.name) != 7) {
        return false;
    }
    new.has_start = strcmp(start, "-") != 0;
    new.start = new.has_start ? strtod(start, NULL) : 0.0;
    new.is_derivative = strcmp(state, "-") != 0;
    new.state = new.is_derivative ? (fmi2ValueReference)strtoul(state, NULL, 10) : 0;
    variables = grown(variables, variable_count, sizeof *variables);
    variables[variable_count++] = new;
    return true;
}

static bool read_derivative(const char *line)
{
    fmi2ValueReference derivative;
    if (sscanf(line, "derivative %u", &derivative) != 1) {
        return false;
    }
    for (size_t i = 0; i < variable_count; i++) {
        if (variables[i].reference == derivative && variables[i].is_derivative) {
            states.references = grown(states.references, states.count, sizeof *states.references);
            states.derivatives = grown(states.derivatives, states.count, sizeof *states.derivatives);
            states.references[states.count] = variables[i].state;
            states.derivatives[states.count++] = derivative;
            return true;
        }
    }
    return false;
}

void read_sheet(const char *file)
{
    FILE *stream = fopen(file, "r");
    char line[512];
    if (stream == NULL) {
        perror(file);
        exit(2);
    }
    while (fgets(line, sizeof line, stream) != NULL) {
        if (!read_attribute(line) && !read_variable(line) && !read_derivative(line)) {
            fprintf(stderr, "%s: this line means nothing: %s", file, line);
            exit(2);
        }
    }
    fclose(stream);
}

const char *attribute(const char *name)
{
    for (size_t i = 0; i < attribute_count; i++) {
        if (strcmp(attributes[i].name, name) == 0) {
            return attributes[i].value;
        }
    }
    return NULL;
}

double number(const char *name)
{
    const char *value = attribute(name);
    return value == NULL ? 0.0 : strtod(value, NULL);
}

const struct variable *variable(const char *name)
{
    for (size_t i = 0; i < variable_count; i++) {
        if (strcmp(variables[i].name, name) == 0) {
            return &variables[i];
        }
    }
    return NULL;
}

size_t references_of(char type, const char *causality, fmi2ValueReference **list)
{
    size_t count = 0;
    *list = NULL;
    for (size_t i = 0; i < variable_count; i++) {
        if (variables[i].type == type && (causality == NULL || strcmp(variables[i].causality, causality) == 0)) {
            *list = grown(*list, count, sizeof **list);
            (*list)[count++] = variables[i].reference;
        }
    }
    return count;
}
