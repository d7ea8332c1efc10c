"""A cusp of an arm: met in floating point, proved by its certificate."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice

from cuspaudit.auditing.limits.joint_limits import interval_of, rational_limits
from cuspaudit.auditing.proofs.certified_robot import certified_robot
from cuspaudit.auditing.search.cusps import FoundCusp, refined_cusp, search_cusps
from cuspaudit.certificate import CuspCertificate, Verification, verify
from cuspaudit.robot.chain import Chain

__all__ = ["CuspWitness", "find_cusps", "same_cusp"]

_TRIES = 6


@dataclass(frozen=True, eq=False)
class CuspWitness:
    """A posture next to which the map of the task has a cusp, and the proof.

    Attributes:
        chain: the chain whose numbers the certificate holds.
        posture: joint values in chain order.
        slack: its distance to the nearest limit; inf without limits.
        certificate: what `cuspaudit verify` reads; with the limits of the chain where
            the cusp is inside them.
        verification: what the checker said; accepted.
    """

    chain: Chain
    posture: tuple[float, ...]
    slack: float
    certificate: CuspCertificate
    verification: Verification

    @property
    def is_inside(self) -> bool:
        """Whether the claim is one within joint limits."""
        return self.certificate.limits is not None


def find_cusps(
    chain: Chain, seed: int = 0, inside: bool = True
) -> Iterator[CuspWitness]:
    """Proved cusps of a chain, the clearest first.

    Args:
        chain: three joints and task "position", or six and "pose".
        seed: of the search.
        inside: whether the cusps have to be inside the limits of the chain.
    """
    limited = inside and any(joint.limits for joint in chain.joints)
    limits = [interval_of(joint) if limited else None for joint in chain.joints]
    for found in islice(search_cusps(chain, limits, seed), _TRIES):
        proved = _proved(chain, found, limited)
        if proved is not None:
            yield proved


def same_cusp(cusp: CuspWitness, chain: Chain) -> CuspWitness | None:
    """The cusp of slightly different numbers next to ``cusp``, if it is proved."""
    limited = cusp.is_inside
    limits = [interval_of(joint) if limited else None for joint in chain.joints]
    found = refined_cusp(chain, limits, cusp.posture)
    return None if found is None else _proved(chain, found, limited)


def _proved(chain: Chain, found: FoundCusp, limited: bool) -> CuspWitness | None:
    certificate = CuspCertificate(
        **certified_robot(chain),
        limits=rational_limits(chain) if limited else None,
        posture=_fractions(found.posture),
    )
    result = verify(certificate)
    if not result.accepted:
        return None
    return CuspWitness(chain, found.posture, found.slack, certificate, result)


def _fractions(posture: Sequence[float]) -> tuple[Fraction, ...]:
    return tuple(Fraction(repr(value)) for value in posture)
