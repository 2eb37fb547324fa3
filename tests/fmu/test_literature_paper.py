"""The rotor of Sorokin and Zhang, packaged and run by fmpy, against its reference in quadruple precision."""

import motion
import numpy as np

R_C = 1e-10  # [m], measured 8e-12
AXIS = 1e-8  # [rad], measured 1.1e-9
PHI = 1e-9  # [rad], measured 8e-11


def test_literature_paper_trajectory(paper, reference):
    """The scene as it is: dop853 at 1e-10, 10 s in steps of 0.01 s."""
    result = paper.simulate()
    assert len(reference) == 101
    rows = result[np.searchsorted(result["time"], reference["t"] - 1e-6)]
    np.testing.assert_allclose(rows["time"], reference["t"], rtol=0.0, atol=1e-9)
    columns = lambda prefix: np.stack([reference[prefix + c] for c in "xyz"], axis=-1)
    assert motion.distance(motion.vectors(rows, "r_c"), columns("r")) <= R_C
    assert motion.distance(motion.vectors(rows, "axis"), motion.axis(columns("g"))) <= AXIS
    assert np.abs(rows["phi"] - reference["phi"]).max() <= PHI
