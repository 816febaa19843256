"""The search for teeth: a scenario, its free keys, what to minimise and what must hold."""

from tribodyn.studies.protocol.study import Study

STUDY = Study(
    kind="design",
    about="a search for the values of a scenario's free keys that minimise its quantities",
    package=__name__,
    quantities="evaluations of a search",
    resumes=True,
)
