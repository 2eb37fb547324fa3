"""What an FMU says about itself: its modelDescription.xml, as far as the report needs it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Parameter:
    """A parameter and its start value, an enumeration's by its name."""

    name: str
    value: str
    unit: str
    description: str

    @property
    def block(self):
        """What stands before the first dot: rotor, start, solver, or an effect."""
        return self.name.partition(".")[0]


@dataclass(frozen=True)
class Scene:
    """A scene as packaged: its experiment [s], its method of integration, its parameters, its origin."""

    title: str
    identifier: str
    start: float
    stop: float
    step: float
    relative_tolerance: float
    """What the experiment asks of the adaptive methods [-], which stands in for the parameter."""
    method: str
    parameters: dict[str, Parameter]
    outputs: tuple[str, ...]
    fmi_version: str
    version: str
    guid: str

    @classmethod
    def of(cls, description):
        """The scene behind fmpy's ModelDescription."""
        experiment = description.defaultExperiment
        parameters = [_parameter(v) for v in description.modelVariables if v.causality == "parameter"]
        return cls(
            title=description.description or description.modelName,
            identifier=description.coSimulation.modelIdentifier,
            start=float(experiment.startTime or 0.0),
            stop=float(experiment.stopTime),
            step=float(experiment.stepSize),
            relative_tolerance=float(experiment.tolerance),
            method=_method(description),
            parameters={p.name: p for p in parameters},
            outputs=tuple(v.name for v in description.modelVariables if v.causality == "output"),
            fmi_version=description.fmiVersion,
            version=description.version or "–",
            guid=description.guid,
        )

    def value(self, name):
        """A parameter's number in its SI unit, 0 where the scene has no such parameter."""
        return float(self.parameters[name].value) if name in self.parameters else 0.0

    def blocks(self, *kinds):
        """The blocks of these kinds that act: bearing[1], bearing[2], …; a general FMU has switches for them. All, if no kind is named."""
        every = dict.fromkeys(p.block for p in self.parameters.values())
        names = [name for name in every if not kinds or name.partition("[")[0] in kinds]
        off = {p.name.partition(".")[2] for p in self.parameters.values() if p.block == "effects" and p.value == "false"}
        return [name for name in names if name not in off]


def _method(description):
    """The name of the method of integration: that of solver.method, unless solver.method_number is another's."""
    by_name = {variable.name: variable for variable in description.modelVariables}
    named = by_name["solver.method"]
    number = int(by_name["solver.method_number"].start) or int(named.start)
    return next(item.name for item in named.declaredType.items if int(item.value) == number)


def _parameter(variable):
    kind = variable.declaredType
    value = variable.start
    if variable.type == "Enumeration":
        value = next(item.name for item in kind.items if int(item.value) == int(value))
    unit = variable.unit or (kind.unit if kind else None)
    return Parameter(variable.name, value, unit or "", variable.description or "")
