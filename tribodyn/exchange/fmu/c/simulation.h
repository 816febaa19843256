/* What an instance simulates: its variables by number, and a model that is moved on in time.
 *
 * Written for the model of the FMU is simulation.c, which defines all of this. Everything that changes lies
 * in `values`, one for each variable, and in `numbers`; the model is a copy of its own for each instance,
 * which follows from the values.
 */
#ifndef SIMULATION_H
#define SIMULATION_H

#include <stddef.h>
#include <stdint.h>

/* What a variable is to the importer. */
enum role { TIME_OF_MODEL, INPUT, FIXED_PARAMETER, TUNABLE_PARAMETER, OUTPUT };

struct variable {
    const char *name;
    enum role role;
    double start;
    double minimum; /* this and the next: of what may be set */
    double maximum;
};

/* Beside the functions below it defines the constants
 *   model_size                    bytes of a model
 *   variable_count, number_count  variables, the number of each its place; numbers that a run changes
 *   variables[]                   a struct variable for each
 *   token[]                       text that tells FMUs apart
 *   usual_tolerance               relative, unless the importer gives one
 */

/* Make a model. */
static void simulation_prepare(void *model);
/* Put the numbers where the simulation begins, at time 0. */
static void simulation_start(void *model, const double *values, double *numbers);
/* Move on to a time, s since the start; 0, or what `simulation_reason` puts into words. */
static int advance_simulation(
    void *model, const double *values, double *numbers, double until, double tolerance);
/* Time that has been reached, s since the start. */
static double simulation_time(const double *numbers);
/* Fill in the values of the outputs. */
static void find_outputs(void *model, double *values, double *numbers);
static const char *simulation_reason(int status);

#endif
