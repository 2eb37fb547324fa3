{#- The numbers of one model, beside linear.c and equations.h, which are the same in each. -#}
/* The linear model {{ identifier }}, written by split-rotor {{ version }}. */
#ifndef MATRICES_H
#define MATRICES_H

/* Linked into a program, functions begin with the model's name (FMI 2.0.4, section 2.1.1); those of a library that is loaded do not.
   The last is what CMake defines where it builds one. */
#if defined FMI2_OVERRIDE_FUNCTION_PREFIX
#define PREFIX FMI2_OVERRIDE_FUNCTION_PREFIX
#elif defined {{ identifier }}_EXPORTS
#define PREFIX
#else
#define PREFIX {{ identifier }}_
#endif

#define GUID "{{ guid }}"

/* Columns: states and inputs. Rows: rates of the states, and outputs. Value references go through the columns, then the rows. */
enum { STATES = {{ states }}, COLUMNS = {{ columns }}, ROWS = {{ variables | length - columns }} };

static const char *const NAMES[COLUMNS + ROWS] = {
  {%- for one in variables %}
    "{{ one.name }}",
  {%- endfor %}
};

/* Of each variable, in its unit: 0 of states, which are counted from it, and of their rates. */
static const double STEADY[COLUMNS + ROWS] = {
  {%- for one in variables %}
    {{ one.steady }},
  {%- endfor %}
};

/* How large the states are about to be, each in its unit. */
static const double NOMINAL[STATES] = {
  {%- for one in variables[:states] %}
    {{ one.nominal }},
  {%- endfor %}
};

/* A and B; C and D */
static const double MATRIX[ROWS][COLUMNS] = {
  {%- for one in variables[columns:] %}
    { {{ one.entries | join(", ") }} },
  {%- endfor %}
};

#endif
