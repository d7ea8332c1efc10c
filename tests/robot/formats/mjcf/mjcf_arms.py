"""MJCF models of arms inside packages, and what MuJoCo itself says of one."""

from __future__ import annotations

import importlib.util
from collections.abc import Sequence
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

_KEPT = {
    *("mujoco", "compiler", "default", "joint", "freejoint", "worldbody", "body"),
    *("frame", "site"),
}


def packaged_models() -> list[Path]:
    """The robots in robosuite and robosuite-models, without importing them."""
    found: list[Path] = []
    for package in ("robosuite", "robosuite_models"):
        spec = importlib.util.find_spec(package)
        for place in (spec.submodule_search_locations or []) if spec else []:
            found += sorted(Path(place).rglob("robots/*/robot.xml"))
    return found


class Peer:
    """An MJCF model in MuJoCo, with its bodies and joints alone."""

    def __init__(self, path: Path) -> None:
        mujoco = pytest.importorskip("mujoco")
        tree = ElementTree.parse(path).getroot()
        self._strip(tree)
        compiler = tree.find("compiler")
        if compiler is None:
            compiler = ElementTree.SubElement(tree, "compiler")
        compiler.attrib |= {"boundmass": "1", "boundinertia": "1"}
        for name in ("meshdir", "texturedir", "balanceinertia"):
            compiler.attrib.pop(name, None)
        self._mujoco = mujoco
        text = ElementTree.tostring(tree, encoding="unicode")
        self.model = mujoco.MjModel.from_xml_string(text)
        self.data = mujoco.MjData(self.model)

    def _strip(self, element: ElementTree.Element) -> None:
        for child in list(element):
            if child.tag in _KEPT:
                self._strip(child)
            else:
                element.remove(child)

    def tip(
        self, base: str, tip: str, joints: Sequence[str], values: Sequence[float]
    ) -> np.ndarray:
        """The frame of a site or a body in that of another, at values of joints."""
        self.data.qpos[:] = self.model.qpos0
        for name, value in zip(joints, values, strict=True):
            self.data.qpos[self.model.joint(name).qposadr[0]] = value
        self._mujoco.mj_kinematics(self.model, self.data)
        return np.linalg.inv(self._frame(base)) @ self._frame(tip)

    def _frame(self, name: str) -> np.ndarray:
        sites = {self.model.site(k).name for k in range(self.model.nsite)}
        placed = self.data.site(name) if name in sites else self.data.body(name)
        frame = np.eye(4)
        frame[:3, :3] = placed.xmat.reshape(3, 3)
        frame[:3, 3] = placed.xpos
        return frame
