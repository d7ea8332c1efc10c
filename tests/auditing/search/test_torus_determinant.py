"""det J on the torus of joints 2 to 5."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from short_tables import arm

from cuspaudit.auditing.search.torus_determinant import TorusDeterminant
from cuspaudit.kinematics.postures.numeric import PostureSolver
from cuspaudit.robot.chain import Chain

HUNDREDTHS = st.integers(-150, 150).map(lambda k: f"{k / 100}")
DEGREES = st.integers(-180, 180)
ARMS = st.builds(
    arm,
    st.lists(HUNDREDTHS, min_size=6, max_size=6),
    st.lists(HUNDREDTHS, min_size=6, max_size=6),
    st.lists(DEGREES, min_size=6, max_size=6),
)


@settings(max_examples=20, deadline=None)
@given(ARMS, st.integers(0, 1000))
def test_it_is_the_determinant(chain: Chain, seed: int) -> None:
    """At random postures of a random arm h is det J, whatever joints 1 and 6 are."""
    solver = PostureSolver.of(chain)
    h = TorusDeterminant.of(solver)
    postures = np.random.default_rng(seed).uniform(-np.pi, np.pi, (10, 6))
    expected = solver.determinants(postures)
    assert h(postures[:, 1:5]) == pytest.approx(expected, abs=1e-12)


def test_the_gradient_is_that_of_differences() -> None:
    """Central differences of h along the four axes."""
    chain = arm(
        (1, 2, ".3", 1, ".6", 2), (1, 3, 1, ".5", 2, 1), (20, 31, 45, 81, 12, 0)
    )
    h = TorusDeterminant.of(PostureSolver.of(chain))
    x = np.random.default_rng(0).uniform(-np.pi, np.pi, (5, 4))
    step = 1e-5 * np.eye(4)
    slopes = np.stack([(h(x + e) - h(x - e)) / 2e-5 for e in step], -1)
    assert h.gradient(x) == pytest.approx(slopes, abs=1e-7)
