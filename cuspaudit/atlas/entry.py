"""An arm of the atlas: its line of the table, and the files behind it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

__all__ = ["Entry", "entry_from_record", "failed_entry"]

_MAKERS = {
    word: maker
    for maker, words in {
        "ABB": "abb",
        "Adept": "adept",
        "AgileX": "agilex piper",
        "Annin": "annin",
        "Aubo": "aubo",
        "Barrett": "barrett wam",
        "Comau": "comau edo",
        "Denso": "denso",
        "Dobot": "dobot",
        "Doosan": "doosan",
        "Elephant": "elephant mecharm mycobot",
        "Fairino": "fairino",
        "Fanuc": "fanuc",
        "Franka": "franka panda fr3",
        "Hans": "hans",
        "I2RT": "i2rt yam",
        "JAKA": "jaka",
        "Kawasaki": "kawasaki",
        "Kinova": "kinova jaco j2n6s200 j2n6s300 gen3",
        "KUKA": "kuka iiwa",
        "Mitsubishi": "mitsubishi",
        "Motoman": "motoman yaskawa",
        "RealMan": "realman",
        "Robotis": "robotis",
        "Rokae": "rokae",
        "Schunk": "schunk lwa4p lwa4d",
        "Standard Bots": "standardbots",
        "Staubli": "staubli",
        "Techman": "techman",
        "Trossen": "trossen vx300s wx250s",
        "UFACTORY": "ufactory xarm6 xarm7 lite6 uf850",
        "Unimation": "puma unimation",
        "Unitree": "unitree z1",
        "Universal Robots": "ur3 ur5 ur10 ur16 ur20 ur30 ur3e ur5e ur10e ur16e ur",
    }.items()
    for word in words.split()
}
"""The maker that a word of a robot's name stands for."""


@dataclass(frozen=True)
class Entry:
    """A line of the table.

    Attributes:
        slug: name of its files.
        name: of the robot.
        file: where it was read, as the user named it.
        maker: by a word of its name; "" where none is known.
        error: why there is no audit, one line; "" where there is one.
        joints: their number.
        task: what of the tip is to be reached.
        verdict: of the three; None without an audit.
        within_limits: the verdict within joint limits, where there is one.
        structure: the theorem that gave the verdict, or the kind of its proof.
        aspects: their number; None when not known.
        aspects_proved: whether that is proved.
        postures: the largest number of postures of a pose, likewise.
        postures_proved: whether that is proved.
        clearance: of a witness path, proved.
        margin: rad about the path without a singularity, where it is known.
        certificate: kind of the certificate; "" where there is none.
        picture: a drawing in SVG.
        group: name of its robot's files; the entries of one robot have one.
        key: of the file's content and of what made the entry.
    """

    slug: str
    name: str
    file: str
    maker: str = ""
    error: str = ""
    joints: int | None = None
    task: str = ""
    verdict: str | None = None
    within_limits: str | None = None
    structure: str = ""
    aspects: int | None = None
    aspects_proved: bool = False
    postures: int | None = None
    postures_proved: bool = False
    clearance: float | None = None
    margin: float | None = None
    certificate: str = ""
    picture: str = field(default="", repr=False)
    group: str = ""
    key: str = ""


def entry_from_record(
    slug: str, file: str, record: Mapping[str, Any], certificate: str, picture: str
) -> Entry:
    """The line of an audited arm.

    Args:
        slug: name of its files.
        file: where it was read.
        record: the audit's JSON.
        certificate: kind of its certificate, or "".
        picture: a drawing.
    """
    robot, proof = record["robot"], record["proof"]
    return Entry(
        slug=slug,
        name=str(robot["name"]),
        file=file,
        maker=_maker(f"{robot['name']} {slug}"),
        joints=robot["joints"],
        task=str(robot["task"]),
        verdict=record["verdict"],
        within_limits=_part(record, "limits").get("verdict"),
        structure=proof["reduction"] or proof["kind"],
        aspects=record["aspects"]["count"],
        aspects_proved=bool(record["aspects"]["proved"]),
        postures=record["postures"]["max"],
        postures_proved=bool(record["postures"]["proved"]),
        clearance=_part(record, "witness").get("clearance"),
        margin=_part(record, "margin").get("joint_angle"),
        certificate=certificate,
        picture=picture,
    )


def failed_entry(slug: str, file: str, error: str) -> Entry:
    """The line of a file that could not be audited."""
    name = re.split(r"[\\/]", file)[-1]
    return Entry(slug, name, file, _maker(slug), error=" ".join(error.split()))


def _part(record: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    return record.get(key) or {}


def _maker(text: str) -> str:
    words = re.split(r"[^a-z0-9]+", text.lower())
    return next((_MAKERS[word] for word in words if word in _MAKERS), "")
