"""The structure certificate of a noncuspidal verdict that rests on a theorem.

What is written is what `cuspaudit.certificate.verify` accepts. The relations of each
theorem are proposed wherever they can stand in the arm, those of the theorem that gave
the verdict first, and the first certificate that is proved is the one. So the proof
does not lean on the code that gave the verdict, and an arm whose relations do not
follow from its exact numbers has none.
"""

from __future__ import annotations

from collections.abc import Iterator

from cuspaudit.auditing.proofs.certified_robot import certified_robot, regular_posture
from cuspaudit.certificate import Relation, StructureCertificate, Word, verify
from cuspaudit.robot.chain import Chain

__all__ = ["structure_certificate"]

_WORDS: tuple[Word, ...] = ("parallel", "meeting")
_PLACES = (
    *(((4, 5, 6), (2, 3)), ((4, 5, 6), (1, 2)), ((1, 2, 3), (4, 5))),
    *(((1, 2, 3), (5, 6)), ((2, 3, 4), (5, 6)), ((3, 4, 5), (1, 2))),
)
"""Where three axes in a row and two others can stand among six."""


def structure_certificate(chain: Chain, first: str = "") -> StructureCertificate | None:
    """A proved certificate that ``chain`` is noncuspidal, or None.

    Args:
        chain: of three, four or six joints, its virtual joint included.
        first: name of the theorem to be tried first.
    """
    robot, regular = certified_robot(chain), regular_posture(chain)
    proposals = sorted(_proposals(chain), key=lambda each: each[0] != first)
    for theorem, relations in proposals:
        certificate = StructureCertificate(
            **robot, theorem=theorem, relations=relations, regular=regular
        )
        if verify(certificate).accepted:
            return certificate
    return None


def _proposals(chain: Chain) -> Iterator[tuple[str, tuple[Relation, ...]]]:
    """Each theorem's name with the relations that it could rest on."""
    if chain.task == "position":
        for axes in ((2, 3), (1, 2)):
            for word in _WORDS:
                yield "pair of axes", (Relation(axes, word),)
        yield "no offset", (Relation((1, 2, 3), "level"),)
    elif chain.task == "position-and-angle":
        turning = [k for k, kind in enumerate(chain.kinds, 1) if kind == "revolute"]
        yield "parallel axes", (Relation(tuple(turning), "parallel"),)
        square = Relation((1, 2), "square")
        yield "yaw and pitch", (square, Relation((2, 3, 4), "parallel"))
    else:
        yield from _of_six_joints()


def _of_six_joints() -> Iterator[tuple[str, tuple[Relation, ...]]]:
    corners = ((1, 2), (4, 5), (5, 6))
    at_right_angles = [
        Relation(axes, word) for axes in corners for word in ("meeting", "square")
    ]
    yield "UR pattern", (Relation((2, 3, 4), "parallel"), *at_right_angles)
    points = {(4, 5, 6): "spherical wrist", (1, 2, 3): "spherical shoulder"}
    for triple, pair in _PLACES:
        for word in _WORDS:
            if triple in points:
                meeting = Relation(triple, "meeting")
                yield points[triple], (meeting, Relation(pair, word))
    for triple, rest in (((4, 5, 6), (1, 2, 3)), ((1, 2, 3), (4, 5, 6))):
        yield points[triple], (Relation(triple, "meeting"), Relation(rest, "level"))
    for triple, pair in _PLACES:
        for word in _WORDS:
            for other in _WORDS:
                relations = Relation(triple, word), Relation(pair, other)
                yield "triple and pair", relations
