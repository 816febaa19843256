/* FMI 2.0 for co-simulation: the functions of the standard over an instance.
 *
 * Names, types and values are those of "Functional Mock-up Interface for Model Exchange and Co-Simulation",
 * version 2.0.
 */
#define STANDARD fmi2
#define BOOLEAN int
#define STATE(verb) JOIN(verb, FMUstate)
#define DESERIALIZE DeSerialize
#if defined(FMI2_FUNCTION_PREFIX)
#define PREFIX FMI2_FUNCTION_PREFIX
#endif
#include "functions.c"

typedef void *fmi2Component;
typedef void *fmi2ComponentEnvironment;
typedef void *fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef const char *fmi2String;
typedef char fmi2Byte;
typedef int fmi2Status; /* the first values are those of `enum status` */
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum { fmi2DoStepStatus, fmi2PendingStatus, fmi2LastSuccessfulTime, fmi2Terminated } fmi2StatusKind;

typedef void (*fmi2Logger)(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String, fmi2String, ...);

typedef struct {
    fmi2Logger logger;
    void *(*allocateMemory)(size_t, size_t);
    void (*freeMemory)(void *);
    void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
    fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

typedef struct {
    fmi2Boolean newDiscreteStatesNeeded, terminateSimulation, nominalsOfContinuousStatesChanged;
    fmi2Boolean valuesOfContinuousStatesChanged, nextEventTimeDefined;
    fmi2Real nextEventTime;
} fmi2EventInfo;

static void report(const struct instance *one, enum status status, const char *category, const char *message)
{
    if (one->logger != NULL)
        ((fmi2Logger)one->logger)(one->environment, one->name, (fmi2Status)status, category, "%s", message);
}

DECLARED(const char *, fmi2GetTypesPlatform)(void)
{
    return "default";
}

DECLARED(const char *, fmi2GetVersion)(void)
{
    return "2.0";
}

DECLARED(fmi2Component, fmi2Instantiate)(
    fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
    const fmi2CallbackFunctions *callbacks, fmi2Boolean visible, fmi2Boolean logging)
{
    const char *wrong = NULL;
    struct instance *one = instantiated(name);
    if (one == NULL)
        return NULL;
    one->report = report;
    if (callbacks != NULL) {
        one->logger = (void (*)(void))callbacks->logger;
        one->environment = callbacks->componentEnvironment;
    }
    one->logs_steps = logging;
    if (type != fmi2CoSimulation)
        wrong = "fmi2Instantiate: this FMU is for co-simulation alone";
    else if (guid == NULL || strcmp(guid, token) != 0)
        wrong = "fmi2Instantiate: the guid is not that of this FMU";
    if (wrong != NULL) {
        failed(one, "%s", wrong);
        release(one);
        return NULL;
    }
    return one;
}

DECLARED(fmi2Status, fmi2SetupExperiment)(
    fmi2Component one, fmi2Boolean given, fmi2Real tolerance, fmi2Real start, fmi2Boolean ends, fmi2Real stop)
{
    if (refused(one, "fmi2SetupExperiment", INSTANTIATED, INSTANTIATED))
        return ERROR;
    return (fmi2Status)set_experiment(one, start, given, tolerance);
}

DECLARED(fmi2Status, fmi2EnterInitializationMode)(fmi2Component one)
{
    if (refused(one, "fmi2EnterInitializationMode", INSTANTIATED, INSTANTIATED))
        return ERROR;
    enter(one, INITIALIZING);
    return OK;
}

DECLARED(fmi2Status, fmi2GetReal)(
    fmi2Component one, const fmi2ValueReference references[], size_t count, fmi2Real values[])
{
    return (fmi2Status)get_values(one, references, count, values);
}

DECLARED(fmi2Status, fmi2SetReal)(
    fmi2Component one, const fmi2ValueReference references[], size_t count, const fmi2Real values[])
{
    return (fmi2Status)set_values(one, references, count, values);
}

/* Variables of other types: there are none. */
#define WITHOUT(name, type)                                                                            \
    DECLARED(fmi2Status, name)(                                                                        \
        fmi2Component one, const fmi2ValueReference references[], size_t count, type values[])         \
    {                                                                                                  \
        return count == 0 ? OK : failed(one, #name ": all variables are real numbers");                \
    }

WITHOUT(fmi2GetInteger, fmi2Integer)
WITHOUT(fmi2GetBoolean, fmi2Boolean)
WITHOUT(fmi2GetString, fmi2String)
WITHOUT(fmi2SetInteger, const fmi2Integer)
WITHOUT(fmi2SetBoolean, const fmi2Boolean)
WITHOUT(fmi2SetString, const fmi2String)

DECLARED(fmi2Status, fmi2DoStep)(fmi2Component one, fmi2Real from, fmi2Real size, fmi2Boolean final)
{
    if (refused(one, "fmi2DoStep", STEPPING, STEPPING))
        return ERROR;
    return (fmi2Status)step(one, from, size);
}

DECLARED(fmi2Status, fmi2GetRealStatus)(fmi2Component one, const fmi2StatusKind kind, fmi2Real *value)
{
    if (kind != fmi2LastSuccessfulTime)
        return (fmi2Status)failed(one, "fmi2GetRealStatus: steps are done when fmi2DoStep returns");
    return (fmi2Status)get_value(one, 0, value);
}

DECLARED(fmi2Status, fmi2GetBooleanStatus)(fmi2Component one, const fmi2StatusKind kind, fmi2Boolean *value)
{
    if (kind != fmi2Terminated)
        return (fmi2Status)failed(one, "fmi2GetBooleanStatus: steps are done when fmi2DoStep returns");
    *value = phase_of(one) == FAILED;
    return OK;
}

/* What this FMU does not have. */
#define STANDARD_2 fmi2Component one

UNSUPPORTED(fmi2GetStatus, (STANDARD_2, const fmi2StatusKind kind, fmi2Status *value))
UNSUPPORTED(fmi2GetIntegerStatus, (STANDARD_2, const fmi2StatusKind kind, fmi2Integer *value))
UNSUPPORTED(fmi2GetStringStatus, (STANDARD_2, const fmi2StatusKind kind, fmi2String *value))
UNSUPPORTED(fmi2CancelStep, (STANDARD_2))
UNSUPPORTED(
    fmi2GetDirectionalDerivative,
    (STANDARD_2, const fmi2ValueReference unknown[], size_t unknowns, const fmi2ValueReference known[],
     size_t knowns, const fmi2Real seed[], fmi2Real derivative[]))
UNSUPPORTED(
    fmi2SetRealInputDerivatives,
    (STANDARD_2, const fmi2ValueReference references[], size_t count, const fmi2Integer order[],
     const fmi2Real values[]))
UNSUPPORTED(
    fmi2GetRealOutputDerivatives,
    (STANDARD_2, const fmi2ValueReference references[], size_t count, const fmi2Integer order[],
     fmi2Real values[]))

/* Model exchange. */
UNSUPPORTED(fmi2EnterEventMode, (STANDARD_2))
UNSUPPORTED(fmi2NewDiscreteStates, (STANDARD_2, fmi2EventInfo *info))
UNSUPPORTED(fmi2EnterContinuousTimeMode, (STANDARD_2))
UNSUPPORTED(
    fmi2CompletedIntegratorStep,
    (STANDARD_2, fmi2Boolean unset, fmi2Boolean *enter_event_mode, fmi2Boolean *terminate))
UNSUPPORTED(fmi2SetTime, (STANDARD_2, fmi2Real time))
UNSUPPORTED(fmi2SetContinuousStates, (STANDARD_2, const fmi2Real states[], size_t count))
UNSUPPORTED(fmi2GetDerivatives, (STANDARD_2, fmi2Real derivatives[], size_t count))
UNSUPPORTED(fmi2GetEventIndicators, (STANDARD_2, fmi2Real indicators[], size_t count))
UNSUPPORTED(fmi2GetContinuousStates, (STANDARD_2, fmi2Real states[], size_t count))
UNSUPPORTED(fmi2GetNominalsOfContinuousStates, (STANDARD_2, fmi2Real nominals[], size_t count))
