"""Which serial chain of a tree is meant, and what each of several would give.

Which link is the tip can change the verdict, so it is taken without being named only
when there is one place it can be. Otherwise the candidates are listed, likely ones
first, each with joints and a task that was tried.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from cuspaudit.errors import InvalidRobotError
from cuspaudit.robot.chain import Chain, Task
from cuspaudit.robot.formats.tree import Branch, E, Tree
from cuspaudit.robot.frames import transform
from cuspaudit.robot.place import listing, quoted
from cuspaudit.robot.proposals import fitting_locks, fitting_tasks
from cuspaudit.robot.task import DIMENSIONS, default_task

__all__ = ["Build", "Candidate", "candidates", "chains_beside", "choose_chain"]

Build = Callable[[str, str], tuple[Chain, list[str]]]
"""From base and tip to the chain and remarks on what was read."""

_MOST_SHOWN = 8
_MOST_BESIDE = 20
_MOST_JOINTS = 7
_GRIPS = re.compile("grip|jaw|finger|claw", re.IGNORECASE)
_LIKELY = (6, 7, 5, 4, 3)


@dataclass(frozen=True, slots=True)
class Candidate:
    """A serial chain that may be meant.

    Attributes:
        base: the link it begins at.
        tip: the link it ends at.
        joints: the names of its moving joints.
        chain: the chain; None when it cannot be read.
        refusal: why not; "" when it can.
        task: a task that was tried and works; None when none does.
        locked: joints to lock at 0 for it.
        is_jaw: whether its last joint moves a jaw or a finger.
        is_at_root: whether its base is that of the whole tree.
    """

    base: str
    tip: str
    joints: tuple[str, ...]
    chain: Chain | None
    refusal: str
    task: Task | None
    locked: tuple[str, ...]
    is_jaw: bool
    is_at_root: bool

    @property
    def is_arm(self) -> bool:
        """Whether it can be audited as it is proposed, and ends in no jaw."""
        return self.task is not None and not self.is_jaw

    @property
    def options(self) -> str:
        """The options that choose it, as they can be pasted into a shell."""
        words = [] if self.is_at_root else ["--base", self.base]
        words += ["--tip", self.tip]
        left = len(self.joints) - len(self.locked)
        if self.task is not None and self.task != default_task(left):
            words += ["--task", self.task]
        for name in self.locked:
            words += ["--lock", f"{name}=0"]
        return " ".join(shlex.quote(word) for word in words)

    @property
    def remark(self) -> str:
        """How many joints it has, and its task or why there is none."""
        count = len(self.joints)
        said = ["1 joint" if count == 1 else f"{count} joints"]
        if self.task is not None:
            said.append(f"task {self.task}")
        elif self.refusal:
            said.append(f"refused: {self.refusal}")
        if self.is_jaw:
            said.append(f"{quoted(self.joints[-1])} moves this link alone, a jaw?")
        return ", ".join(said)

    def record(self) -> dict[str, object]:
        """The candidate as `cuspaudit import --json` writes it."""
        return {
            "base": self.base,
            "tip": self.tip,
            "joints": list(self.joints),
            "task": self.task,
            "locked": list(self.locked),
            "is_jaw": self.is_jaw,
            "options": self.options,
            "remark": self.remark,
        }


def candidates(tree: Tree[E], build: Build, base: str, most: int) -> list[Candidate]:
    """The serial chains of a tree, likely ones first, the first ``most`` tried.

    A chain begins at ``base`` while it has at most 7 joints, else where the tree forks
    last. What is likely: no jaw, a task that works, then 6, 7, 5, 4, 3 joints.
    """
    ends = sorted(_ends(tree, base), key=lambda pair: _unlikelihood(tree, *pair))
    tried = [_candidate(tree, build, base, *pair) for pair in ends[:most]]
    return sorted(tried, key=lambda one: (one.is_jaw, one.task is None))


def choose_chain(
    tree: Tree[E], build: Build, base: str, tip: str | None
) -> tuple[Chain, list[str]]:
    """The chain from ``base`` to ``tip``, or the only one that there is.

    Raises:
        InvalidRobotError: several chains may be meant; the message lists them.
    """
    if tip is not None:
        tree.check_link(tip)
        return build(base, tip)
    branches = tree.branches(base)
    if not branches:
        return build(base, _deepest(tree, base, tree.body(base)))
    count = len(_ends(tree, base))
    if len(branches) == count == 1:
        return _one_tip(tree, build, base, branches[0].tips)
    shown = candidates(tree, build, base, _MOST_SHOWN)
    if len(shown) == 1:
        return build(shown[0].base, shown[0].tip)
    texts = [f"{one.options} ({one.remark})" for one in shown]
    rest = f"; ... ({count} in all)" if count > len(shown) else ""
    found = f"{count} chains may be meant"
    raise tree.place.error(found, f"choose one: {'; '.join(texts)}{rest}")


def chains_beside(tree: Tree[E], build: Build, chain: Chain) -> tuple[Chain, ...]:
    """The same chain to other links of the body that its tip is on, the first 20."""
    found = []
    others = [link for link in tree.beside(chain.tip) if tree.path(chain.base, link)]
    for link in others[:_MOST_BESIDE]:
        with suppress(InvalidRobotError):
            other, _ = build(chain.base, link)
            if len(other.joints) == len(chain.joints):
                found.append(replace(other, task=chain.task))
    return tuple(found)


def _ends(tree: Tree[E], base: str) -> list[tuple[Branch[E], str]]:
    """The branches that end somewhere, each with the link its chain begins at.

    A branch may end in a bare link that is called a jaw, by its name or its joint's:
    then the arm may end before it as well.
    """
    found = []
    every = [
        one for branch in tree.branches(base) for one in _without_jaw(tree, branch)
    ]
    for branch in every:
        if not branch.goes_on:
            path = tree.path(base, branch.tips[0]) or ()
            moving = [joint for joint in path if joint.kind != "fixed"]
            start = base if len(moving) <= _MOST_JOINTS else branch.base
            found.append((branch, start))
    return found


def _without_jaw(tree: Tree[E], branch: Branch[E]) -> list[Branch[E]]:
    """The branch; of one that ends in what is called a jaw also that up to the jaw."""
    last = branch.joints[-1]
    named = _GRIPS.search(f"{last.name} {last.child}")
    is_bare = branch.tips == (last.child,) and not tree.below.get(last.child)
    if branch.goes_on or not named or not is_bare:
        return [branch]
    if branch.is_jaw or len(branch.joints) == 1:
        return [branch]
    arm = replace(branch, tips=(last.parent,), joints=branch.joints[:-1])
    return [arm, replace(branch, is_jaw=True)]


def _unlikelihood(tree: Tree[E], branch: Branch[E], start: str) -> tuple[bool, int]:
    path = tree.path(start, branch.tips[0]) or ()
    count = sum(joint.kind != "fixed" for joint in path)
    return branch.is_jaw, _LIKELY.index(count) if count in _LIKELY else len(_LIKELY)


def _candidate(
    tree: Tree[E], build: Build, root: str, branch: Branch[E], start: str
) -> Candidate:
    """A branch as a candidate, its task tried."""
    tip = _deepest(tree, start, branch.tips)
    joints = tuple(j.name for j in tree.path(start, tip) or () if j.kind != "fixed")
    chain: Chain | None = None
    refusal, task = "", None
    locked: tuple[str, ...] = ()
    try:
        chain, _ = build(start, tip)
        task, locked = _tried(chain)
    except InvalidRobotError as error:
        refusal = f"{error.where}: {error.found}" if error.where else error.found
    return Candidate(
        start, tip, joints, chain, refusal, task, locked, branch.is_jaw, start == root
    )


def _tried(chain: Chain) -> tuple[Task | None, tuple[str, ...]]:
    """A task that the chain can do, and the joints to lock for it."""
    tasks = fitting_tasks(chain)
    if tasks:
        return tasks[0], ()
    count = len(chain.joints)
    largest = max(n for n in DIMENSIONS.values() if n < count) if count > 3 else 0
    locks = fitting_locks(chain, count - largest, 1) if largest else []
    return (default_task(largest), locks[0]) if locks else (None, ())


def _deepest(tree: Tree[E], base: str, tips: Sequence[str]) -> str:
    """The tip with the most joints on its path, the first of several."""
    return max(tips, key=lambda tip: len(tree.path(base, tip) or ()))


def _one_tip(
    tree: Tree[E], build: Build, base: str, tips: Sequence[str]
) -> tuple[Chain, list[str]]:
    """The chain to the tip with the most fixed joints after the last moving one.

    Unless the task is a pose, its verdict depends on the point, and may depend on the
    axes of its frame; then the tips must coincide.
    """
    tip = _deepest(tree, base, tips)
    chain, remarks = build(base, tip)
    if len(tips) > 1:
        placed = np.array([transform(build(base, other)[0].tool) for other in tips])
        seen = placed[:, :3, 3] if chain.task == "position" else placed
        if chain.task != "pose" and float(np.ptp(seen, axis=0).max()) > 1e-12:
            ways = [f"--tip {shlex.quote(other)}" for other in tips[:_MOST_SHOWN]]
            found = f"{len(tips)} possible tips on one body"
            raise tree.place.error(found, f"choose one: {'; '.join(ways)}")
        remarks.append(f"tip {quoted(tip)} taken among {listing(list(tips))}")
    return chain, remarks
