"""What an FMU logs once of speeds at which the law of a bearing is not known."""

from host import Host

FILM = 400.0
"""The highest speed of the tables of film_bearings [rad/s]."""


def _said(host, words):
    return [line for line in host.log if words in line]


def test_regress_a_table_that_is_left_is_logged_once(fmus):
    with Host(fmus["film_bearings"]) as host:
        host.start({"start.omega.x": FILM - 5.0, "drive.tau": 60.0})
        for i in range(4):
            assert host.step(0.001 * i, 0.001) == 0
        assert _said(host, "beyond its table") == []
        for i in range(4, 60):
            assert host.step(0.001 * i, 0.001) == 0
        said = _said(host, "beyond its table")
        assert len(said) == 2, host.log
        assert all("known from 0.0 rad/s (0.0 rpm) to 400.0 rad/s (3819.7 rpm)" in line for line in said)
        assert ["bearing[1]" in said[0], "bearing[2]" in said[1]] == [True, True]


def test_regress_constants_at_negative_spin_are_logged_once(fmus):
    with Host(fmus["rotor"]) as host:
        names = ["effects.gravity", "effects.support", "effects.bearing[1]"]
        host.slave.setBoolean([host.reference(name) for name in names], [False, False, True])
        bearing = {"position": 0.0, "kyy": 1e4, "kzz": 1e4, "kyz": 50.0, "kzy": -50.0, "cyy": 20.0, "czz": 20.0}
        host.start({"start.omega.x": -50.0} | {f"bearing[1].{name}": value for name, value in bearing.items()})
        for i in range(5):
            assert host.step(0.01 * i, 0.01) == 0
        said = _said(host, "turns backwards")
        assert len(said) == 1 and "bearing[1]" in said[0] and "-50.0 rad/s" in said[0], host.log
