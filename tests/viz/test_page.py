from __future__ import annotations

import base64
import json
import re
from html.parser import HTMLParser
from typing import Any

import pytest
from drawn_arms import audit_of, crx_chain, issac_chain, issac_path, slider_chain

from cuspaudit.viz import build_scene, render_page, sample_path, sample_postures
from cuspaudit.viz.scene.strip import build_strip

EVIL = "<script>alert(1)</script>"


class Reader(HTMLParser):
    """Collects tags with their attributes, and the text outside scripts and style."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.text = ""
        self._inside = ""

    def handle_starttag(self, tag: str, attrs: Any) -> None:
        """Note the tag."""
        self.tags.append((tag, dict(attrs)))
        self._inside = tag
        self.text += " "

    def handle_endtag(self, tag: str) -> None:
        """Leave the tag."""
        self._inside = ""

    def handle_data(self, data: str) -> None:
        """Note the text a reader sees."""
        if self._inside not in ("script", "style"):
            self.text += data


def read(html: str) -> Reader:
    """The page, read."""
    reader = Reader()
    reader.feed(html)
    reader.text = " ".join(reader.text.split())
    return reader


def cuspidal_page(name: str = "Orthogonal 3R") -> str:
    """The page of the ISSAC arm under another name."""
    chain = issac_chain(name)
    path = issac_path(chain)
    scene = build_scene(chain, sample_path(chain, path))
    return render_page(audit_of(chain, "cuspidal", path), scene, certificate='{"a": 1}')


def test_the_page_loads_nothing_and_is_small() -> None:
    """No attribute asks for a file, and the policy forbids it; 5 MB are not reached."""
    html = cuspidal_page()
    reader = read(html)
    for _, attributes in reader.tags:
        for name in ("src", "href", "srcset", "action", "data", "poster"):
            value = attributes.get(name) or "data:"
            assert value.startswith("data:"), value
    assert "@import" not in html
    policies = [a["content"] for _, a in reader.tags if "http-equiv" in a]
    assert "default-src 'none'" in str(policies)
    assert len(html.encode()) < 2_000_000


def test_a_name_is_only_a_name() -> None:
    """A robot called <script> shows as text, and adds no element."""
    plain, evil = read(cuspidal_page()), read(cuspidal_page(EVIL))
    assert EVIL in evil.text
    assert [tag for tag, _ in plain.tags] == [tag for tag, _ in evil.tags]


def test_every_text_of_the_audit_is_escaped() -> None:
    """Whatever the audit says, no tag of it reaches the page."""
    chain = issac_chain()

    def poisoned(value: Any) -> Any:
        if isinstance(value, dict):
            return {f"{k}": poisoned(v) for k, v in value.items()}
        if isinstance(value, list):
            return [poisoned(v) for v in value]
        return f'{value}"><img src=x onerror=alert(1)>' if value is None else value

    audit = poisoned(audit_of(chain, "noncuspidal", None))
    audit["proof"]["why"] = audit["robot"]["file"] = EVIL
    audit["singular"]["factors"] = [EVIL, EVIL]
    reader = read(render_page(audit))
    assert {"img"}.isdisjoint(tag for tag, _ in reader.tags)
    assert not any("onerror" in attributes for _, attributes in reader.tags)


def test_the_page_says_what_the_audit_says() -> None:
    """Verdict, proof, command, counts with proof, snapped numbers, versions, seed."""
    text = read(cuspidal_page()).text
    for words in (
        "cuspidal It can change posture without meeting a singularity.",
        "A certified path joins two postures of one aspect.",
        "FLINT resultants, ball arithmetic",
        "cuspaudit verify issac.certificate.json",
        "2 proved",
        "4 not proved",
        "4 not stated",
        "joint_2 rpy[0] 1.5708 pi/2",
        "pinocchio",
        "1.3·10⁻¹³",
        "python-flint 0.9.0",
        "Seed 0",
        "2*c2 - s3",
    ):
        assert words in text, words


def test_the_certificate_can_be_downloaded() -> None:
    """The link holds the certificate's bytes, under its name."""
    (link,) = [a for t, a in read(cuspidal_page()).tags if a.get("id") == "certificate"]
    assert link["download"] == "issac.certificate.json"
    blob = str(link["href"]).removeprefix("data:application/json;base64,")
    assert json.loads(base64.b64decode(blob)) == {"a": 1}


@pytest.mark.parametrize(
    ("verdict", "reason"),
    [
        ("noncuspidal", "No path is shown because none exists"),
        ("undecided", "No reduction applies."),
        ("cuspidal", "the audit's proof does not contain one"),
    ],
)
def test_without_a_path_the_page_says_why(verdict: str, reason: str) -> None:
    """Postures are shown instead, and the sentence names the reason."""
    chain = slider_chain()
    shown = sample_postures(chain, [[0, 0, 100], [1, 200, -300]])
    audit = audit_of(chain, verdict, None)
    text = read(render_page(audit, build_scene(chain, shown))).text
    assert reason in text
    assert "The arm is shown in 2 postures" in text
    assert reason in read(render_page(audit)).text


def test_missing_parts_leave_no_trace() -> None:
    """An audit of a system, without robot, and one of null parts are rendered."""
    text = read(render_page({"verdict": "undecided", "robot": None})).text
    assert "This system" in text
    assert "None" not in text


def test_the_same_audit_gives_the_same_bytes() -> None:
    """No clock and no address of a network card goes into the page."""
    assert cuspidal_page() == cuspidal_page()


def test_the_strip_stays_off_zero() -> None:
    """The curve keeps clear of its zero line, on a bent scale when it must."""
    chain = issac_chain()
    strip = build_strip(chain, sample_path(chain, issac_path(chain)))
    assert strip.unit == "m³"
    assert strip.scale == ""
    assert strip.sign == "positive"
    assert max(strip.heights) < strip.zero - 5
    near = sample_path(chain, [[0, -0.742, 2.628], [0, -0.742, 1.6]])
    bent = build_strip(chain, near)
    assert bent.sign == "positive"
    assert max(bent.heights) < bent.zero - 3


def test_the_policy_allows_the_scripts_that_are_there() -> None:
    """One hash a script, and no script without: viewer and page, checker and call."""
    html = cuspidal_page()
    scripts = re.findall(r"<script>", html)
    assert len(re.findall(r"sha256-", html)) == len(scripts) == 4


def test_a_pose_of_six_joints_shows_its_axes() -> None:
    """The page of a 6R speaks of position and orientation."""
    chain = crx_chain()
    shown = sample_postures(chain, [[0.1] * 6])
    html = render_page(audit_of(chain, "noncuspidal", None), build_scene(chain, shown))
    assert "position and orientation" in read(html).text
