"""Masters that step FMUs together, each as a function of the models, the links, what is watched, the step [s] and how many steps: the watched
values after each step."""


class StepFailed(Exception):
    """A model did not make its step."""
