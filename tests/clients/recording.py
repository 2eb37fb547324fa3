"""What recorder.c wrote, read again. Its head tells what a line is."""

from dataclasses import dataclass
from typing import Any, NamedTuple
from urllib.parse import unquote_to_bytes

OK, WARNING = range(2)


@dataclass(frozen=True)
class Object:
    """An instance or a saved state, by its number."""

    number: int


class Place(NamedTuple):
    """What a pointer leads to, before and after the call."""

    before: Any
    after: Any


class Call(NamedTuple):
    """A call of one function. A text is bytes, bytes are a bytearray; a str is the word `callbacks` or `void`."""

    function: str
    arguments: list
    returned: Any

    @property
    def accepted(self):
        """Whether the callee did what was asked: only then does it write."""
        return not isinstance(self.returned, int) or self.returned in (OK, WARNING)

    @property
    def result(self):
        """All that came of the call."""
        return self.returned, [a.after for a in self.arguments if isinstance(a, Place)] if self.accepted else []


WORDS = {"null": None, "callbacks": "callbacks", "void": "void"}


def value(token):
    """The value that this text stands for."""
    if token in WORDS:
        return WORDS[token]
    kind, inner = token[0], token[1:-1]
    if kind == "#":
        return Object(int(token[1:]))
    if kind == '"':
        return unquote_to_bytes(inner)
    if kind == "'":
        return bytearray(unquote_to_bytes(inner))
    if kind in "[{":
        values = [value(element) for element in inner.split(",") if element]
        return values if kind == "[" else tuple(values)
    return float.fromhex(token) if any(mark in token for mark in ("x", "inf", "nan")) else int(token)


def argument(token):
    """The argument that this text stands for: a value or a place."""
    before, equals, after = token.partition("=")
    return Place(value(before) if before else None, value(after)) if equals else value(token)


def call(line):
    """The call that this line tells."""
    function, *arguments, arrow, returned = line.split()
    assert arrow == "->", line
    return Call(function, [argument(token) for token in arguments], value(returned))


def calls(text):
    """All calls of a recording, in the order in which they returned."""
    return [call(line) for line in text.splitlines()]


def trajectory(calls):
    """The communication points after the start, as (time, {value reference: value}), with what the host read there."""
    points = []
    for call in calls:
        if call.function == "fmi2DoStep" and call.accepted:
            _instance, start, step, _ = call.arguments
            points.append((start + step, {}))
        elif call.function == "fmi2GetReal" and call.accepted and points:
            _instance, references, _n, values = call.arguments
            points[-1][1].update(zip(references, values.after))
    return points
