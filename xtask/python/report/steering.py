"""The inputs of a scene over time, given to an FMU that fmpy runs."""

import numpy as np


class Steering:
    """Inputs that are linear between their points, held before and after them; where two times are equal, they jump.

    `inputs` is a list of dicts: the `name` of an input, `time` [s] and `value` in its unit, of equal length.
    """

    def __init__(self, description, inputs):
        references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self._inputs = [(references[one["name"]], one) for one in inputs]
        self._bends = sorted({t for one in inputs for t in one["time"]})

    def at(self, t):
        """The value of each input at time `t` [s], by its name."""
        return {one["name"]: _course(one, t)[0] for _, one in self._inputs}

    def stop_where_inputs_bend(self, fmu):
        """Make `fmu` end a step wherever an input bends or jumps, and set value and rate from there on."""
        step, has_begun = fmu.doStep, False

        def steered(currentCommunicationPoint, communicationStepSize, **named):  # noqa: N803 (fmpy's names)
            nonlocal has_begun
            t, end = currentCommunicationPoint, currentCommunicationPoint + communicationStepSize
            bends = [bend for bend in self._bends if t <= bend < end]
            for start in bends if has_begun else [t, *(bend for bend in bends if bend > t)]:
                if start > t:
                    step(currentCommunicationPoint=t, communicationStepSize=start - t, **named)
                self._set(fmu, start, [pair for pair in self._inputs if not has_begun or start in pair[1]["time"]])
                has_begun, t = True, start
            return step(currentCommunicationPoint=t, communicationStepSize=end - t, **named)

        if self._inputs:
            fmu.doStep = steered

    @staticmethod
    def _set(fmu, t, inputs):
        references = [reference for reference, _ in inputs]
        values, rates = zip(*(_course(one, t) for _, one in inputs), strict=True)
        fmu.setReal(references, values)
        fmu.setRealInputDerivatives(references, [1] * len(references), rates)


def _course(one, t):
    """The value at time `t` and how fast it changes from there on."""
    time, value = one["time"], one["value"]
    after = int(np.searchsorted(time, t, side="right"))
    if after in (0, len(time)):
        return value[0 if after == 0 else -1], 0.0
    rate = (value[after] - value[after - 1]) / (time[after] - time[after - 1])
    return value[after - 1] + rate * (t - time[after - 1]), rate
