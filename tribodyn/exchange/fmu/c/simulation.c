/* What an instance simulates: @title.
 *
 * The equations are those of model.c; here are the variables, and how they stand in the model.
 */
#include "simulation.h"

#include "model.h"

#include <math.h>
#include <string.h>

/* Lengths, and numbers of variables. */
enum {
    STATES = @states,
    CLOCK_ROWS = @clock_rows,
    STARTS = @starts,
    OUTPUTS = @outputs,
    OIL_NUMBERS = @oil_numbers,
    OIL_POINTS = @oil_points,
    variable_count = @variable_count
};

/* Places in the state; in the clock those of the time, and of the steps so far. */
enum { LAG = @lag, SLIP = @slip, OUTPUT_TURN = @output_turn, TIME = @time_row, STEPS = @steps_row };

/* Places of the numbers that a run changes; those of the shaft and the acceleration hold since a step began. */
enum {
    CLOCK = STATES,
    ACCELERATION = STATES + CLOCK_ROWS,
    SHAFT_SINCE,
    SHAFT_ANGLE,
    SHAFT_SLIP,
    SHAFT_ACCELERATION,
    number_count
};

/* Value references. */
enum {
@references
};

static const struct variable variables[] = {
@variables
};

static const char token[] = "@token";
static const double usual_tolerance = @tolerance;

/* Time of a reference cycle at nominal speed, s; nominal speeds of the reference, and over it, rad/s. */
static const double nominal_time = @nominal_time;
static const double nominal_speed = @nominal_speed;
static const double input_ratio = @input_ratio;
static const double output_ratio = @output_ratio;
/* Torque of the load on the output for which the states at the start are, N m. */
static const double starting_torque = @starting_torque;

/* Speeds of the input at the start, rad/s, with state and clock there. */
static const double start_speeds[STARTS] = { @start_speeds };
static const double start_states[STARTS][STATES] = {
@start_states
};
static const double start_clock[CLOCK_ROWS] = { @start_clock };

/* Place of the variable for each output of the model, 0 where there is none. */
static const int32_t output_variables[OUTPUTS] = { @output_variables };
@oil_tables
struct simulation {
    Model model;
    TimeControl control;
    double tolerances[STATES];
    double work@work;
    double buffer@buffer;
    double oil_temperature;
};

static const size_t model_size = sizeof(struct simulation);

static void simulation_prepare(void *model)
{
    struct simulation *one = model;
    one->model = @{name}_model;
    one->control = @{name}_control;
    one->oil_temperature = @oil_nominal;
    memset(one->work, 0, sizeof one->work);
    memset(one->buffer, 0, sizeof one->buffer);
}
@oil_functions
/* Put the inputs where the model reads them. */
static void put_inputs(struct simulation *one, const double *values, const double *numbers)
{
    (void)values;
    (void)numbers;
@inputs
}

static double simulation_time(const double *numbers)
{
    return numbers[CLOCK + TIME] * nominal_time;
}

/* The state at a speed of the input, between the two of the nearest speeds that are known. */
static void start_at(double speed, double *state)
{
    int i, above = 0;
    double share;
    while (above < STARTS - 1 && start_speeds[above] < speed)
        above++;
    memcpy(state, start_states[above], sizeof start_states[above]);
    if (speed == start_speeds[above])
        return;
    if (above > 0 && start_speeds[above] > speed) {
        share = (start_speeds[above] - speed) / (start_speeds[above] - start_speeds[above - 1]);
        for (i = 0; i < STATES; i++)
            state[i] += share * (start_states[above - 1][i] - state[i]);
    }
    state[SLIP] = speed / input_ratio - nominal_speed;
}

static void simulation_start(void *model, const double *values, double *numbers)
{
    (void)model;
    memset(numbers, 0, number_count * sizeof *numbers);
    start_at(values[@start_variable], numbers);
    memcpy(numbers + CLOCK, start_clock, sizeof start_clock);
@start_shaft
}

static int advance_simulation(
    void *model, const double *values, double *numbers, double until, double tolerance)
{
    struct simulation *one = model;
    double scale = tolerance / usual_tolerance;
    int i;
    for (i = 0; i < STATES; i++)
        one->tolerances[i] = scale * @{name}_control.atol[i];
    one->control.atol = one->tolerances;
    one->control.rtol = tolerance;
    numbers[CLOCK + STEPS] = 0.0; /* their limit is one of a communication step */
@steps
    put_inputs(one, values, numbers);
    return (int)@{name}_advance(
        until, &one->control, &one->model, numbers, numbers + CLOCK, one->work, one->buffer);
}

static void find_outputs(void *model, double *values, double *numbers)
{
    struct simulation *one = model;
    double found[OUTPUTS];
    int i;
    put_inputs(one, values, numbers);
    @{name}_outputs(&one->model, numbers, numbers + CLOCK, one->work, one->buffer, found);
    for (i = 0; i < OUTPUTS; i++)
        if (output_variables[i] > 0)
            values[output_variables[i]] = found[i];
}

static const char *simulation_reason(int status)
{
    static const char *const reasons[] = { @reasons };
    int count = (int)(sizeof reasons / sizeof *reasons);
    return status > 0 && status < count ? reasons[status] : "unknown reason";
}
