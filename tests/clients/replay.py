"""Recorded calls made once more, directly on a library, with the same bits."""

import ctypes
from ctypes import byref, c_char_p, c_double, c_int, c_size_t, c_void_p, pointer

from fmpy import calloc, free
from fmpy.fmi2 import (
    fmi2CallbackAllocateMemoryTYPE,
    fmi2CallbackFreeMemoryTYPE,
    fmi2CallbackFunctions,
    fmi2CallbackLoggerTYPE,
)
from recording import Call, Object, Place

ELEMENTS = {int: c_int, float: c_double, bytes: c_char_p, type(None): c_char_p}
"""The C type of what stands in an array or a struct; a value reference is as wide as an int."""
RETURNS = {int: c_int, bytes: c_char_p, Object: c_void_p, type(None): c_void_p, str: None}
"""The C type of what a function returns; the one str is `void`."""


def array(values):
    """The C type of these values."""
    return ELEMENTS[type(values[0]) if values else float] * len(values)


def room(value):
    """Zeros, in the place of which a value like this can be written."""
    if isinstance(value, list):
        return array(value)()
    if isinstance(value, tuple):
        fields = [(f"field_{i}", ELEMENTS[type(field)]) for i, field in enumerate(value)]
        return type("Struct", (ctypes.Structure,), {"_fields_": fields})()
    if isinstance(value, bytearray):
        return ctypes.create_string_buffer(len(value))
    # A whole number is an int or a size_t: there is room for either.
    return {float: c_double, int: c_size_t, bytes: c_char_p}.get(type(value), c_void_p)()


class Replay:
    """A library, and the objects that it made in the place of the recorded ones."""

    def __init__(self, library):
        self.library = ctypes.CDLL(str(library))
        self.pointers = {}
        self.callbacks = fmi2CallbackFunctions()
        self.callbacks.logger = fmi2CallbackLoggerTYPE(lambda *_message: None)
        self.callbacks.allocateMemory = fmi2CallbackAllocateMemoryTYPE(calloc)
        self.callbacks.freeMemory = fmi2CallbackFreeMemoryTYPE(free)

    def call(self, recorded):
        """Makes the call; it comes back with what was written and returned now."""
        function = self.library[recorded.function]
        function.restype = RETURNS[type(recorded.returned)]
        passed = [self._passed(argument) for argument in recorded.arguments]
        returned = function(*passed)
        arguments = [
            Place(argument.before, self._read(place.contents, argument.after))
            if isinstance(argument, Place)
            else argument
            for argument, place in zip(recorded.arguments, passed)
        ]
        return Call(recorded.function, arguments, self._known(returned, recorded.returned))

    def _passed(self, argument):
        """An argument for ctypes."""
        if isinstance(argument, Place):
            place = room(argument.after)
            if isinstance(argument.before, Object):
                place.value = self.pointers[argument.before.number]
            return pointer(place)
        if isinstance(argument, Object):
            return c_void_p(self.pointers[argument.number])
        if isinstance(argument, list):
            return array(argument)(*argument)
        if isinstance(argument, str):
            return byref(self.callbacks)
        # As wide as a register: right for an int too.
        kinds = {int: c_size_t, float: c_double, bytearray: bytes}
        return kinds.get(type(argument), c_char_p)(argument)

    def _read(self, place, recorded):
        """What stands there now, in the form of what was recorded."""
        if isinstance(recorded, list):
            return list(place)
        if isinstance(recorded, tuple):
            return tuple(getattr(place, name) for name, _ in place._fields_)
        if isinstance(recorded, bytearray):
            return bytearray(place.raw)
        if isinstance(recorded, int):
            return c_int(place.value).value
        return self._known(place.value, recorded)

    def _known(self, value, recorded):
        """A value; a pointer becomes the object that was recorded there."""
        if isinstance(recorded, Object) and value is not None:
            self.pointers[recorded.number] = value
            return recorded
        return "void" if recorded == "void" else value


def messages(calls, library):
    """What the instances of these calls log."""
    said = []
    replay = Replay(library)
    replay.callbacks.logger = fmi2CallbackLoggerTYPE(lambda *message: said.append(message[4].decode()))
    for recorded in calls:
        replay.call(recorded)
    return said


def first_difference(calls, library):
    """The line, the recorded call and what came of it now, where the library first gives other bits; else None."""
    replay = Replay(library)
    for line, recorded in enumerate(calls, 1):
        again = replay.call(recorded)
        # The text of a float tells its bits, and -0.0 from 0.0.
        if repr(again.result) != repr(recorded.result):
            return line, recorded, again.result
    return None
