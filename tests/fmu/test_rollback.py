"""fmpy saves and restores the FMU state of the packaged FMU: what follows has the same bits."""

from host import OK

STEP = 0.013  # [s]


def walk(host, start, steps):
    """All outputs after each of so many steps."""
    shown = []
    for i in range(steps):
        assert host.step(start + i * STEP, STEP) == OK
        shown.append(host.outputs())
    return shown


def test_exact_rollback(fmu):
    with fmu.host() as host:
        host.start()
        walk(host, 0.0, 7)
        saved = host.slave.getFMUState()
        expected = walk(host, 7 * STEP, 20)
        host.slave.setFMUState(saved)
        assert walk(host, 7 * STEP, 20) == expected
        host.slave.freeFMUState(saved)
