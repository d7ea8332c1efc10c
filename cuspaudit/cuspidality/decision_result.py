"""What a run of Algorithm 1 comes to, and what it asks of a route to connectivity."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from flint import fmpq
from numpy.typing import NDArray

from cuspaudit.algebra.points.parametrization import RealPoint
from cuspaudit.algebra.ring import Polynomial
from cuspaudit.algebra.system import PolynomialMap, PolynomialSystem
from cuspaudit.cuspidality.couple_first import Couple
from cuspaudit.cuspidality.verdict import Verdict
from cuspaudit.errors import UnableError
from cuspaudit.runtime.steps import Step

__all__ = ["Connectivity", "Decision"]


class Connectivity(Protocol):
    """The components of V - {Delta = 0}, by either route."""

    @property
    def grounds(self) -> Collection[str]:
        """What their completeness rests on beside exact arithmetic and balls."""

    @property
    def number_of_components(self) -> int:
        """Their number, proved."""

    def component(self, point: RealPoint) -> int:
        """The number of the component of a point with Delta != 0."""

    def path(self, first: RealPoint, second: RealPoint) -> NDArray[np.float64]:
        """Way points on V between two points of one component."""


@dataclass(eq=False)
class Decision:
    """One run of Algorithm 1, as far as it came.

    Attributes:
        variety: V = {f = 0}.
        mapping: R.
        verdict: UNDECIDED until the run has ended.
        engine: the route to connectivity that gave the verdict.
        minors: Delta, or several minors with {Delta = 0} for their common zeros on V.
        atypical: polynomials g with the atypical values among their zeros.
        samples: real points over some values; of a complete run over one value, at
            least, in every cell of {g != 0}.
        most_is_proved: whether no regular value has more real points than these.
        components: the number of components of V - {Delta = 0}, proved; None where
            the verdict did not need it and it took too long.
        couple: of a cuspidal map.
        rests_on: what the verdict rests on.
        steps: the steps that ended.
        failure: why there is no verdict.
    """

    variety: PolynomialSystem
    mapping: PolynomialMap
    verdict: Verdict = Verdict.UNDECIDED
    engine: str | None = None
    minors: tuple[Polynomial, ...] = ()
    atypical: list[Polynomial] = field(default_factory=list)
    samples: dict[tuple[fmpq, ...], tuple[RealPoint, ...]] = field(default_factory=dict)
    most_is_proved: bool = False
    components: int | None = None
    couple: Couple | None = None
    rests_on: tuple[str, ...] = ()
    steps: tuple[Step, ...] = ()
    failure: UnableError | None = None

    @property
    def most_points(self) -> int | None:
        """The largest number of real points over one of the sample values."""
        return max(map(len, self.samples.values()), default=None)
