"""What the FMU tells its host: which messages, in which categories, fit for hosts that take them as formats."""

from fmpy.simulation import instantiate_fmu
from host import OK
import pytest

UNKNOWN = "100 %d %x"  # formats that a host without arguments for them survives
KNOWN = "logStatusError, logStatusWarning, logStatusDiscard, logEvents, logSolver and logAll"
COMPLAINT = f'there is no category "{UNKNOWN}": there are {KNOWN}'


@pytest.fixture
def host(paper):
    with paper.host() as host:
        yield host


def choose(host, on, *categories):
    return host.status("setDebugLogging", on, categories)


def a_life(host):
    """Something of every kind: events, what the solver chose, an error."""
    assert host.start().step(0.0, 0.1) == OK
    host.refused("doStep", 0.0, 0.1)
    host.slave.terminate()


def test_exact_every_category_is_declared(fmu):
    declared = {category.get("name") for category in fmu.xml.find("LogCategories")}
    with fmu.host() as host:
        for name in declared:
            assert choose(host, True, name) == OK
        choose(host, True)
        a_life(host)
    assert {"logStatusError", "logEvents", "logSolver"} <= {message.category for message in host.log} <= declared


def test_exact_percent_signs_are_doubled(host):
    """The message is a format to some hosts: a lone % would read arguments that are not there."""
    assert host.refused("setDebugLogging", True, [UNKNOWN]) == f"fmi2SetDebugLogging: {COMPLAINT}".replace("%", "%%")


def test_exact_a_host_that_formats_sees_the_text_itself(paper):
    """fmpy's proxy runs each message through vsnprintf."""
    heard = []
    logger = lambda _environment, _instance, _status, _category, message: heard.append(message.decode())
    fmu = instantiate_fmu(str(paper.directory), paper.description, "CoSimulation", logger=logger)
    with pytest.raises(Exception, match="fmi2SetDebugLogging"):
        fmu.setDebugLogging(True, [UNKNOWN])
    fmu.freeInstance()
    assert heard == [f"fmi2SetDebugLogging: {COMPLAINT}"]


def test_exact_without_logging_only_what_is_wrong_is_heard(paper):
    with paper.host(logging=False) as host:
        host.start().run([0.0, 0.1])
        assert host.log == []
        host.refused("doStep", 0.0, 0.1)


def test_exact_one_category_alone(host):
    host.log.clear()
    choose(host, False)
    assert choose(host, True, "logSolver") == OK
    assert host.start().step(0.0, -1.0) != OK
    host.slave.terminate()
    # The tolerance in force, and what was spent.
    assert [message.category for message in host.log] == ["logSolver", "logSolver"]


def test_exact_all_categories_by_one_name(host):
    choose(host, False)
    host.log.clear()
    choose(host, True, "logAll")
    a_life(host)
    assert {message.category for message in host.log} == {"logStatusError", "logEvents", "logSolver"}


def test_exact_logging_switched_off_is_silent(host):
    choose(host, False)
    host.log.clear()
    host.start().step(0.0, -1.0)
    host.slave.terminate()
    assert host.log == []


def test_exact_messages_carry_the_name_of_their_instance(paper):
    names = []
    with paper.host(name="rotor № 1") as host:
        host.slave.reset()
        names = [message.instance for message in host.log]
    assert names == ["rotor № 1"] * 2
