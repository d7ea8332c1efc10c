"""A tree of links joined by joints, and its serial chains.

A body is a set of links that fixed joints hold together. A serial chain runs from the
root, or from a body where the tree forks, to a body where it ends. A body ends a chain
when no joint moves on it; when its joints move fingers alone, shorter than the chain;
or when it holds a fixed frame (a tool) and its one joint moves a bare link (a jaw).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Generic, Protocol, TypeVar

from cuspaudit.robot.place import Place, listing, quoted

__all__ = ["Branch", "Tree", "TreeJoint"]

_LONGEST_FINGER = 5
_FEWEST_TO_HAND = 3


class TreeJoint(Protocol):
    """A joint of a tree: its name, its kind ("fixed" or another), and its two links."""

    @property
    def name(self) -> str:
        """Its name, unique in the tree."""

    @property
    def kind(self) -> str:
        """Its kind; "fixed" when it does not move."""

    @property
    def parent(self) -> str:
        """The link it stands on."""

    @property
    def child(self) -> str:
        """The link it carries."""


E = TypeVar("E", bound=TreeJoint)


@dataclass(frozen=True, slots=True)
class Branch(Generic[E]):
    """A serial chain of a tree.

    Attributes:
        base: the link it begins at.
        tips: the links it may end at, all on one body, in file order.
        joints: the moving joints between, base to tip.
        is_jaw: whether its last joint moves one bare link beside a fixed frame or
            another joint: a jaw or a finger, no tool.
        goes_on: whether the tree forks at its end into chains longer than fingers.
    """

    base: str
    tips: tuple[str, ...]
    joints: tuple[E, ...]
    is_jaw: bool
    goes_on: bool


@dataclass(frozen=True, slots=True)
class Tree(Generic[E]):
    """The links of a robot, joined.

    Attributes:
        place: the file.
        links: every link, in file order.
        above: link to the joint that carries it; roots are absent.
        below: link to the joints it carries, in file order.
        marks: link to the frames fixed on it that end a chain only when named.
    """

    place: Place
    links: Sequence[str]
    above: dict[str, E]
    below: dict[str, list[E]]
    marks: Mapping[str, Sequence[str]] = field(default_factory=dict)

    @property
    def roots(self) -> list[str]:
        """The links that no joint carries."""
        return [link for link in self.links if link not in self.above]

    def path(self, base: str, tip: str) -> tuple[E, ...] | None:
        """The joints from ``base`` out to ``tip``, None if base is not above tip."""
        joints = []
        while tip != base:
            if tip not in self.above:
                return None
            joints.append(self.above[tip])
            tip = self.above[tip].parent
        return tuple(reversed(joints))

    def choose_base(self, tip: str | None, notes: list[str]) -> str:
        """The root above ``tip``, or the only root that carries a joint."""
        if tip is not None:
            self.check_link(tip)
            while tip in self.above:
                tip = self.above[tip].parent
            return tip
        carrying = [link for link in self.roots if link in self.below]
        if len(carrying) > 1:
            found = f"{len(carrying)} links that no joint carries: {listing(carrying)}"
            raise self.place.error(found, "choose one by --base LINK")
        for link in self.roots:
            if link not in carrying:
                notes.append(f"link {quoted(link)} is attached to nothing: left out")
        return carrying[0]

    def check_link(self, name: str) -> None:
        """Check that there is a link ``name``.

        Raises:
            InvalidRobotError: there is none.
        """
        if name not in self.above and name not in self.links:
            found = f"no link is named {quoted(name)}"
            raise self.place.error(found, f"the links are {listing(list(self.links))}")

    def branches(self, base: str) -> list[Branch[E]]:
        """The serial chains below ``base``, each from the last fork or from ``base``.

        A body that holds a fixed frame and carries the rest of a chain, such as a
        forearm with a camera, ends none.
        """
        found: list[Branch[E]] = []
        depths = self._depths(base)
        waiting: list[tuple[str, tuple[E, ...], bool]] = [(base, (), False)]
        while waiting:
            start, joints, beside = waiting.pop()
            body = self.body(joints[-1].child if joints else base)
            moving = [j for k in body for j in self.below.get(k, []) if _moves(j)]
            leaves = [k for k in body if not self.below.get(k)]
            hand = bool(moving) and self._is_hand(joints, moving, leaves, depths)
            ends = bool(joints) and (not moving or hand or len(moving) > 1)
            if ends:
                jaw = beside and self._is_bare(joints[-1], depths)
                tips = tuple(leaves) if leaves and (hand or not moving) else ()
                tips = tips or (moving[0].parent,)
                found.append(
                    Branch(start, tips, joints, jaw, bool(moving) and not hand)
                )
            next_to = bool(leaves) or len(moving) > 1
            for joint in reversed(moving):
                first = joint.parent if ends else start
                taken = () if ends else joints
                waiting.append((first, (*taken, joint), next_to))
        return found

    def body(self, top: str) -> list[str]:
        """The links that fixed joints below ``top`` hold to it, ``top`` first."""
        found, waiting = [], [top]
        while waiting:
            link = waiting.pop()
            found.append(link)
            held = [j.child for j in self.below.get(link, []) if not _moves(j)]
            waiting.extend(reversed(held))
        return found

    def beside(self, link: str) -> list[str]:
        """The other links and marks that fixed joints hold to ``link``."""
        top = link
        while top in self.above and not _moves(self.above[top]):
            top = self.above[top].parent
        body = self.body(top)
        held = [*body, *(mark for each in body for mark in self.marks.get(each, ()))]
        return [each for each in held if each != link]

    def _is_hand(
        self,
        joints: Sequence[E],
        moving: Sequence[E],
        leaves: Sequence[str],
        depths: dict[str, int],
    ) -> bool:
        """Whether a body is a hand: its joints move fingers, or a jaw beside a frame.

        Args:
            joints: those between the last fork and the body.
            moving: those the body carries.
            leaves: its links without a joint.
            depths: of the links, see `_depths`.
        """
        if len(joints) < _FEWEST_TO_HAND:
            return False
        if len(moving) == 1:
            return bool(leaves) and self._is_bare(moving[0], depths)
        longest = max(1 + depths[joint.child] for joint in moving)
        return longest < len(joints) and longest <= _LONGEST_FINGER

    def _is_bare(self, joint: E, depths: dict[str, int]) -> bool:
        return depths[joint.child] == 0 and not self.below.get(joint.child)

    def _depths(self, base: str) -> dict[str, int]:
        """The most moving joints on a way out of each link at or below ``base``."""
        order, waiting = [], [base]
        while waiting:
            link = waiting.pop()
            order.append(link)
            waiting.extend(joint.child for joint in self.below.get(link, []))
        depths: dict[str, int] = {}
        for link in reversed(order):
            depths[link] = max(
                (_moves(j) + depths[j.child] for j in self.below.get(link, [])),
                default=0,
            )
        return depths


def _moves(joint: TreeJoint) -> bool:
    return joint.kind != "fixed"
